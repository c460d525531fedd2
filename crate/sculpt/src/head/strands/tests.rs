//! What brows and lashes must be.

use crate::head::build;
use crate::people::preset;

#[test]
fn dbg_stain() {
    let p = preset("sofia").unwrap();
    let h = build(&p.person, &p.head, p.hair.colour.linear_rgb());
    let m = h.sheet.brow.iter().copied().fold(0.0, f64::max);
    let n = h.sheet.brow.iter().filter(|b| **b > 0.5).count();
    println!("max {m} n {n} of {}", h.sheet.brow.len());
    for (b, a) in h
        .sheet
        .brow
        .iter()
        .zip(&h.sheet.at)
        .filter(|(b, _)| **b > 0.5)
    {
        println!("{b} {a}");
    }
}
