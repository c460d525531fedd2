//! Placeholder for HTTP requests where only the page's own engine is available.

use anyhow::{Result, bail};

/// Returns an error: builds without networking cannot query a server.
pub(super) fn post(address: &str, _path: &str, _form: &[(&str, &str)]) -> Result<Vec<u8>> {
    bail!("the server {address} cannot be queried from here")
}
