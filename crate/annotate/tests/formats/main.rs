//! Tests of the formats.

mod anvil;
mod elan;
mod gsl;
mod plain;
mod random;
mod replay;
mod rules;
mod telling;
