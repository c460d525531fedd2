//! The gate runs before each merge, so its duration is bounded: a new slow test must take its time
//! from another.

use std::fs;
use std::path::Path;

/// The sum of the budgets of the gate's checks, minutes on the reference machine.
const MAX_MINUTES: u32 = 43;

/// The last but one cell of each row of the table in `docs/testing.md` that ends with a share: seconds.
fn budgets(text: &str) -> Vec<u32> {
    text.lines()
        .filter_map(|line| {
            let mut cells = line.trim_end().strip_suffix("% |")?.rsplit('|');
            cells.next();
            cells.next()?.trim().strip_suffix(" s")?.parse().ok()
        })
        .collect()
}

#[test]
fn the_budgets_of_the_gate_stay_within_their_sum() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/testing.md");
    let budgets = budgets(&fs::read_to_string(path).expect("the document of tests is there"));
    assert!(budgets.len() > 10, "only {} budgets", budgets.len());
    let secs: u32 = budgets.iter().sum();
    assert!(
        secs <= MAX_MINUTES * 60,
        "the budgets of docs/testing.md are {secs} s together"
    );
}
