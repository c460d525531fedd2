//! Rendering measurements for benchmarks.

use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::player::{Player, plain};

/// `PictureStatistics` of `web/element/base/types.ts`.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Statistics<'a> {
    adapter: &'a str,
    quality: &'a str,
    draw_calls: u32,
    figure_draw_calls: u32,
    triangles: u32,
}

#[wasm_bindgen]
impl Player {
    /// Returns statistics of the last image; nothing without a canvas.
    pub fn statistics(&self) -> Result<JsValue, JsError> {
        let Some(info) = self.picture_info() else {
            return Ok(JsValue::UNDEFINED);
        };
        let quality = raconteur_render::Quality::NAMES
            .iter()
            .find(|(tier, _)| *tier == info.options.quality)
            .map_or("", |(_, name)| name);
        plain(&Statistics {
            adapter: &info.adapter,
            quality,
            draw_calls: info.draw_calls,
            figure_draw_calls: info.figure_draw_calls,
            triangles: info.triangles,
        })
    }
}
