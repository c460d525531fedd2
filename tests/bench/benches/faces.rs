//! A face of the model, a change of one attribute, and a face applied to a figure. Budgets: the
//! face takes no more than 1.5 times a copy of the modes' bytes in the same run, an attribute 2 ms,
//! the figure 100 ms.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use raconteur_body::read::read_figure;
use raconteur_faces::{Editor, FaceModel, Part, Region};
use raconteur_reshape::{NewFace, NewOrgans, Reshaper};

fn read(path: &str) -> Vec<u8> {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets");
    std::fs::read(format!("{root}/{path}")).expect("an asset")
}

fn faces(c: &mut Criterion) {
    let model = FaceModel::from_bytes(&read("faces/people.faces")).expect("a pack");
    let mut editor = Editor::new(model).expect("a mesh");
    editor
        .add_texture(&read("faces/people.skins"))
        .expect("textures");
    let shape = &editor.model().shape;
    let own = editor.coefficients(&editor.random(3), Part::Shape);
    let own = own.expect("a face");
    let modes: Vec<Vec<f64>> = (0..shape.dimensions())
        .map(|i| shape.mode(i).to_vec())
        .collect();
    let modes = modes.concat();
    c.bench_function("a shape from its coefficients", |b| {
        b.iter(|| shape.face(black_box(&own)));
    });
    c.bench_function("a copy of the modes' bytes", |b| {
        b.iter(|| black_box(&modes).clone());
    });
    let name = "width of the mouth";
    c.bench_function("an attribute of a shape, the whole change", |b| {
        b.iter(|| editor.attribute_change(Part::Shape, name, &Region::whole_head()));
    });
    let change = editor.attribute_change(Part::Shape, name, &Region::whole_head());
    let change = change.expect("an attribute");
    let mut face = editor.random(3);
    c.bench_function("an attribute of a shape, once more", |b| {
        b.iter(|| face.add(&change, black_box(0.001)));
    });
    let mouth = editor.region(&["mouth"], None).expect("a segment");
    c.bench_function("an attribute of a shape in a segment", |b| {
        b.iter(|| editor.attribute_change(Part::Shape, name, &mouth));
    });
    put_on(c, &editor);
}

fn put_on(c: &mut Criterion, editor: &Editor) {
    let figure = read_figure("sofia", &read("figures/sofia.glb")).expect("a figure");
    let reshaper = Reshaper::new(figure, editor.model().vertices()).expect("our head");
    let face = editor.random(3);
    let texture = editor.model().texture.as_ref().expect("textures");
    c.bench_function("a face put on a figure", |b| {
        b.iter(|| {
            let factors = texture.factors(&face.texture, "sofia").expect("known");
            reshaper.with_face(&NewFace {
                skin: &face.shape,
                tone: &factors.skin,
                organs: NewOrgans::from_numbers(&face.organs).expect("organs"),
                iris: factors.iris,
                brows: factors.brows,
            })
        });
    });
}

criterion_group!(benches, faces);
criterion_main!(benches);
