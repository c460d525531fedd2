//! Makes figures from anthropometry; behind the feature `generator`.
//!
//! Each region (head, hands, body, clothes, hair) yields [`part::Part`]s in metres, engine
//! frame, bind pose; [`assemble`] joins them on one skeleton and [`write`] stores glTF.

pub mod part;
pub mod subdivide;
