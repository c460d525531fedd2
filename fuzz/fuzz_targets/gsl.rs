//! Text as a value of each feature of GSL; what is read is written as a text with the same value.
#![no_main]

use raconteur_annotate::gsl::{Feature, Palm, Position, Shape, parse};

fn holds<F: Feature + std::fmt::Debug>(text: &str) {
    match parse::<F>(text) {
        Ok(value) => assert_eq!(parse::<F>(&value.to_string()), Ok(value)),
        Err(error) => assert!(text.get(error.start..error.end).is_some(), "{error}"),
    }
}

libfuzzer_sys::fuzz_target!(|text: &str| {
    holds::<Shape>(text);
    holds::<Palm>(text);
    holds::<Position>(text);
});
