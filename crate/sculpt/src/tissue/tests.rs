//! Additional test muscle, from its rows to the skin.

use raconteur_base::{DAffine3, DVec3};

use super::{layout, with};
use crate::head::{self, Head};
use crate::people;
use raconteur_tissue::{Anatomy, FaceControls, MUSCLES, Muscle, Network, NodeState, Tissue};

const MUSCLES_TABLE: &str = include_str!("../../../tissue/src/muscles.tsv");
/// A made-up muscle that draws the cheek to the front of the ear, and folds it.
const ROW: &str = "Wiggler\tpair\tWiggler\t0.4\t1.0\t1:0.5\t-\t-\t0\tEars\tWiggler\twiggles\n";
const FIBRE: &str = "Wiggler\tline\t6:14\t0.9\t-\tface\t66,-18,52 58,-19,70 50,-20,82 42,-20,86\n";
/// End of the muscle on the mean head, metres.
const END: DVec3 = DVec3::new(0.042, -0.020, 0.086);

fn tissue(head: &Head, fibres: &str, anatomy: &Anatomy) -> Tissue {
    let sheets = layout::read(fibres, anatomy).expect("fibres");
    let place = DAffine3::IDENTITY;
    with(&sheets, &head.soft, &place, &[], &[], head.jaw_hinge)
}

/// Returns the backward displacement of the skin at the end of the test muscle, left and right,
/// metres, and its folding there.
fn seen(tissue: &Tissue, network: &mut Network) -> [[f32; 2]; 2] {
    let mut nodes = vec![NodeState::default(); tissue.rest.len()];
    network.write(tissue, 1.0, &mut nodes);
    [1.0, -1.0].map(|side| {
        let end = END * DVec3::new(side, 1.0, 1.0);
        let far = |i: &usize| DVec3::from_array(tissue.rest[*i].map(f64::from)).distance(end);
        let nearest = (0..nodes.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
        let node = nodes[nearest.expect("a node")];
        [-node.displacement[2], node.wrinkles[1]]
    })
}

#[test]
fn rows_are_all_that_a_muscle_needs() {
    let preset = people::preset("sofia").expect("a figure");
    let head = head::build(&preset.person, &preset.head);
    let shipped = tissue(&head, layout::FIBRES, &Anatomy::SHIPPED);
    let anatomy = Anatomy::read(&format!("{MUSCLES_TABLE}{ROW}")).expect("a table");
    let longer = tissue(&head, &format!("{}{FIBRE}", layout::FIBRES), &anatomy);

    // It comes after all existing muscles and does not change them.
    let by_name = |name: &str| anatomy.by_name(name).expect(name);
    let [left, right] = ["wigglerleft", "WigglerRight"].map(by_name);
    assert_eq!((left.index(), right.index()), (MUSCLES, MUSCLES + 1));
    assert_eq!(
        (anatomy.count(), Muscle::by_name("WigglerLeft")),
        (MUSCLES + 2, None)
    );
    assert!(
        Muscle::all().all(|m| by_name(m.name()) == m),
        "every muscle has a row of its own name"
    );
    let count = shipped.fibres.len();
    assert_eq!(longer.fibres[..count], shipped.fibres);
    assert_eq!(longer.points[..shipped.points.len()], shipped.points);
    let own: Vec<Muscle> = longer.fibres[count..].iter().map(|f| f.muscle).collect();
    assert_eq!(own, [left, right]);

    // When contracted, it moves and folds its own side; a program that does not know it ignores it.
    let rest = FaceControls::default();
    let mut more = vec![0.0; anatomy.count() - MUSCLES];
    more[left.index() - MUSCLES] = 1.0;
    for (anatomy, moves) in [(&anatomy, true), (&Anatomy::SHIPPED, false)] {
        let mut network = Network::with(&longer, anatomy);
        network.reset(&longer, &rest, &rest);
        for _ in 0..120 {
            network.step_with(&longer, &rest, &more);
        }
        let [[moved, folds], [other, unfolded]] = seen(&longer, &mut network);
        assert_eq!(moved > 3e-3, moves, "{moved}");
        assert_eq!(folds > 0.2, moves, "{folds}");
        assert!(other.abs() < 2e-4 && unfolded == 0.0, "{other}");
    }
}
