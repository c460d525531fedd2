//! Hand shapes of HamNoSys as those of EML.

use raconteur_eml::ShapeKey;

/// Hand shapes of EML with the nearest ones of HamNoSys 4 (Hanke 2004), as its tokens: the table of
/// the project's hand shapes, written for EML's own shapes. *Designed*. Of shapes with the same
/// tokens, the first is taken.
const SHAPES: [(u8, &str); 60] = [
    (1, "hamflathand"),
    (2, "hamflathand,hamthumboutmod"),
    (3, "hamflathand,hamthumbacrossmod"),
    (4, "hamfinger2345,hamthumboutmod"),
    (5, "hamfinger2345,hamthumbacrossmod"),
    (6, "hamflathand,hamfingerstraightmod"),
    (7, "hamfinger2345,hamthumboutmod,hamfingerbendmod"),
    (8, "hamfinger2345,hamthumboutmod,hamfingerhookmod"),
    (9, "hamceeall"),
    (10, "hamceeall,hamthumbopenmod"),
    (11, "hampinchall"),
    (12, "hampinchall,hamfingerstraightmod"),
    (13, "hamceeall,hamfingerstraightmod"),
    (14, "hamfist,hamthumbacrossmod"),
    (15, "hamfist"),
    (16, "hamfist,hamthumboutmod"),
    (17, "hamflathand,hamfingerhookmod,hamthumbacrossmod"),
    (18, "hamfist,hamindexfinger,hambetween,hammiddlefinger"),
    (19, "hamfinger2"),
    (20, "hamfinger2,hamfingerhookmod"),
    (21, "hamfinger2,hamfingerstraightmod"),
    (22, "hamfinger2,hamfingerbendmod"),
    (44, "hampinch12,hamindexfinger,hammiddlefinger"),
    (23, "hampinch12,hammiddlefinger,hamindexfinger"),
    (24, "hampinch12"),
    (25, "hamcee12,hamfingerstraightmod"),
    (26, "hamcee12"),
    (27, "hampinch12open"),
    (28, "hamceeopen"),
    (29, "hamceeopen,hamthumbopenmod"),
    (30, "hampinch12open,hamfingerhookmod"),
    (31, "hamfinger2345,hamfingerhookmod,hamindexfinger"),
    (32, "hamfinger2,hamthumboutmod"),
    (33, "hamfinger2,hamthumboutmod,hamfingerhookmod"),
    (34, "hampinch12,hamfingerhookmod"),
    (35, "hampinch12,hamindexfinger,hammiddlefinger"),
    (36, "hamfinger23spread,hamthumbopenmod"),
    (37, "hamfinger23,hamthumbacrossmod"),
    (38, "hamfinger23spread,hamthumbacrossmod"),
    (39, "hamfinger23spread,hamthumbacrossmod,hamfingerhookmod"),
    (40, "hamfinger23,hamthumbacrossmod,hamfingerstraightmod"),
    (
        41,
        "hamfinger23,hamthumbacrossmod,hamindexfinger,hamfingerhookmod",
    ),
    (
        42,
        "hamfinger23,hamthumbacrossmod,hammiddlefinger,hamfingernail,hamindexfinger",
    ),
    (43, "hamfinger23spread,hamthumboutmod"),
    (45, "hamfinger23spread,hamthumboutmod,hamfingerhookmod"),
    (46, "hamfinger23,hamringfinger,hamthumbacrossmod"),
    (47, "hamfinger23spread,hamringfinger,hamthumbacrossmod"),
    (48, "hamfinger23,hamringfinger,hamfingerstraightmod"),
    (49, "hamfinger2,hamthumbacrossmod,hampinky"),
    (50, "hamfinger2,hamthumboutmod,hampinky"),
    (51, "hamfinger2,hamthumbacrossmod,hamindexfinger,hampinky"),
    (52, "hamfinger2,hamthumboutmod,hamindexfinger,hampinky"),
    (53, "hamcee12,hammiddlefinger"),
    (
        54,
        "hamfinger2345,hamthumboutmod,hammiddlefinger,hamfingerstraightmod",
    ),
    (55, "hampinch12open,hammiddlefinger"),
    (56, "hampinch12,hammiddlefinger"),
    (57, "hamflathand,hamfingerbendmod"),
    (58, "hamceeall,hamfingerhookmod"),
    (59, "hamfinger2345,hamthumbopenmod,hamfingerbendmod"),
    (60, "hamfist"),
];

/// Base shapes with related ones, which replace them at a smaller cost: *designed*.
const RELATED: [[&str; 2]; 8] = [
    ["hamflathand", "hamfinger2345"],
    ["hamfinger23", "hamfinger23spread"],
    ["hampinch12", "hampinch12open"],
    ["hampinch12", "hampinchall"],
    ["hamcee12", "hamceeall"],
    ["hamceeopen", "hamceeall"],
    ["hamcee12", "hampinch12"],
    ["hamceeall", "hampinchall"],
];
/// Cost of another base shape, of a related one, and of a missing or surplus modifier.
const OTHER_BASE: u32 = 20;
const RELATED_BASE: u32 = 5;
const MODIFIER: u32 = 2;

/// Nearest hand shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NearestShape {
    pub(super) key: ShapeKey,
    /// True if it is the very shape.
    pub(super) is_exact: bool,
}

/// Returns the shape nearest to a base with its modifiers, all as tokens of HamNoSys.
pub(super) fn nearest(base: &str, modifiers: &[&str]) -> NearestShape {
    let cost = |tokens: &str| {
        let mut tokens = tokens.split(',');
        let own_base = tokens.next().unwrap_or("");
        let own: Vec<&str> = tokens.collect();
        let is_related = RELATED
            .iter()
            .any(|pair| pair.contains(&base) && pair.contains(&own_base));
        let base_cost = match (own_base == base, is_related) {
            (true, _) => 0,
            (false, true) => RELATED_BASE,
            (false, false) => OTHER_BASE,
        };
        let missing = modifiers.iter().filter(|m| !own.contains(m)).count();
        let surplus = own.iter().filter(|m| !modifiers.contains(m)).count();
        let differing = u32::try_from(missing + surplus).unwrap_or(u32::MAX >> 4);
        // The order of fingers is a part of the notation.
        let is_reordered = differing == 0 && own != modifiers;
        base_cost + MODIFIER * differing + u32::from(is_reordered)
    };
    let best = SHAPES.iter().min_by_key(|(_, tokens)| cost(tokens));
    let (id, tokens) = best.copied().unwrap_or((0, ""));
    NearestShape {
        key: ShapeKey { id, blend: None },
        is_exact: cost(tokens) == 0,
    }
}

/// Returns the distance from the wrist to the fingertips of a base shape, skeleton units: *measured*
/// on the shipped figures.
pub(super) fn reach(base: &str) -> f64 {
    match base {
        "hamfist" => 3.8,
        "hampinch12" | "hampinchall" | "hamcee12" | "hamceeall" => 5.6,
        _ => 7.2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_of_the_table_is_found_by_its_own_tokens() {
        for (id, tokens) in SHAPES {
            let parts: Vec<&str> = tokens.split(',').collect();
            let found = nearest(parts[0], &parts[1..]);
            assert!(found.is_exact, "{tokens} is {id}");
            let same = SHAPES.iter().find(|(_, other)| *other == tokens);
            assert_eq!(
                Some(found.key.id),
                same.map(|(first, _)| *first),
                "the first shape with {tokens}"
            );
        }
    }

    #[test]
    fn other_shapes_are_the_nearest() {
        assert_eq!(nearest("hamfinger2", &[]).key.id, 19, "the index finger");
        let thumb = nearest("hamfinger23", &["hamthumboutmod"]);
        assert!(!thumb.is_exact, "{thumb:?}");
        assert_eq!(nearest("hamnothing", &[]).key.id, 1, "the first of all");
    }
}
