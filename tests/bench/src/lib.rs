//! Contains only benchmarks: `cargo bench -p raconteur-bench --bench NAME`.
