//! Renders a frame with wgpu: native and headless, WebGPU, and WebGL2, from one source.
//!
//! Scope: the figure with its materials, skinned on the GPU, or as edges, vertices or bones for
//! inspection; the theatre around it; shadows; tone curve and encoding; read-back; canvases.
//! Out of scope: the content of the frame (`stage`), and motion.
//!
//! The image is rendered in linear light to one `Rgba16Float` target, with four samples per pixel
//! where supported, and encoded in the tone-map pass. Unsupported device features are replaced and
//! reported in [`RenderInfo`], never silently.
//!
//! Frames: right-handed, metres, radians; +x is the character's left, +y up, +z front.

pub mod error;
pub mod frame_pacer;
pub mod options;
pub mod renderer;
pub mod tissue;

mod backdrop;
mod counts;
mod detail;
mod device;
mod device_errors;
mod environment;
mod fallback;
mod figure;
mod gpu;
mod gpu_figure;
mod layouts;
mod lid;
mod lines;
mod lip;
mod morph;
mod overlay;
mod pipeline;
mod shadow;
mod sources;
mod strands;
mod target;
mod texture;
mod tier;
mod uniform;
mod vertices;
mod view;

#[cfg(all(feature = "native", not(target_arch = "wasm32")))]
pub mod headless;
#[cfg(all(any(feature = "webgpu", feature = "webgl"), target_arch = "wasm32"))]
pub mod surface;

pub use error::RenderError;
pub use frame_pacer::FramePacer;
#[cfg(all(feature = "native", not(target_arch = "wasm32")))]
pub use headless::Headless;
pub use options::{Quality, RenderInfo, RenderOptions};
pub use renderer::Renderer;
#[cfg(all(any(feature = "webgpu", feature = "webgl"), target_arch = "wasm32"))]
pub use surface::{Backend, CanvasTarget, RenderStatus};
pub use texture::MAX_SIDE_PX;
pub use wgpu;
