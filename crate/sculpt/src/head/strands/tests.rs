//! What brows and lashes must be.
