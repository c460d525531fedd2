//! Nothing but benches: `cargo bench -p raconteur-bench --bench NAME`.
