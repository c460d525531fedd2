//! A page's canvas as the target.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use raconteur_body::Figure;
use raconteur_stage::Frame;
use wgpu::CurrentSurfaceTexture;

use crate::{FramePacer, Quality, RenderError, RenderInfo, Renderer};

/// Browser graphics API used for rendering: WebGPU or WebGL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backend {
    /// WebGPU; needs the feature `webgpu`.
    WebGpu,
    /// WebGL2; needs the feature `webgl`.
    WebGl,
}

/// Result of rendering a frame to a canvas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RenderStatus {
    /// The frame is on the canvas.
    Drawn,
    /// The canvas had no room for it (hidden, or the browser is late); the next may do.
    Skipped,
    /// The device or context is gone: make a new canvas target.
    DeviceLost,
}

/// Renderer that draws to one canvas of a web page, with automatic quality control.
pub struct CanvasTarget {
    device: wgpu::Device,
    surface: wgpu::Surface<'static>,
    configuration: wgpu::SurfaceConfiguration,
    /// Full image size, pixels.
    size: (u32, u32),
    pace: FramePacer,
    /// True if the image is static, so it is rendered at full size.
    resting: bool,
    renderer: Renderer,
    lost: Arc<AtomicBool>,
    /// WebGL context, used because wgpu does not report its loss.
    #[cfg(feature = "webgl")]
    context: Option<web_sys::WebGl2RenderingContext>,
}

impl CanvasTarget {
    /// Opens a device for a canvas; its `width` and `height` in pixels are the rendered size.
    ///
    /// # Errors
    /// Returns an error if the back end is not built in or not available, or if the canvas already
    /// has a context of another kind.
    pub async fn new(
        canvas: web_sys::HtmlCanvasElement,
        backend: Backend,
    ) -> Result<Self, RenderError> {
        let wanted = match backend {
            Backend::WebGpu => wgpu::Backends::BROWSER_WEBGPU,
            Backend::WebGl => wgpu::Backends::GL,
        };
        if !wgpu::Instance::enabled_backend_features().contains(wanted) {
            return Err(RenderError::NoAdapter(format!(
                "{backend:?} is not in this build"
            )));
        }
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wanted,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let (width, height) = (canvas.width().max(1), canvas.height().max(1));
        let surface = instance
            .create_surface(wgpu::SurfaceTarget::Canvas(canvas.clone()))
            .map_err(|e| RenderError::Surface(e.to_string()))?;
        let (adapter, device, queue) = crate::device::open(&instance, Some(&surface)).await?;
        let lost = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&lost);
        device.set_device_lost_callback(move |_, _| flag.store(true, Ordering::Relaxed));

        let mut configuration = surface
            .get_default_config(&adapter, width, height)
            .ok_or_else(|| RenderError::Surface("no format that the adapter draws".to_owned()))?;
        // The last pass encodes; an sRGB view would only undo and redo it.
        let formats = surface.get_capabilities(&adapter).formats;
        if let Some(plain) = formats.into_iter().find(|f| {
            matches!(
                f,
                wgpu::TextureFormat::Rgba8Unorm | wgpu::TextureFormat::Bgra8Unorm
            )
        }) {
            configuration.format = plain;
        }
        surface.configure(&device, &configuration);
        let pace = FramePacer::new(crate::device::is_software(&adapter.get_info()));
        let renderer = Renderer::new(
            &adapter,
            device.clone(),
            queue,
            configuration.format,
            pace.options(),
        );
        Ok(Self {
            device,
            surface,
            size: (width, height),
            pace,
            resting: true,
            configuration,
            renderer,
            lost,
            #[cfg(feature = "webgl")]
            context: (backend == Backend::WebGl)
                .then(|| webgl_context(&canvas))
                .flatten(),
        })
    }

    /// Returns the renderer's properties, with the counts of the last image.
    #[must_use]
    pub fn info(&self) -> &RenderInfo {
        self.renderer.info()
    }

    /// Uploads a figure; it is rendered until the next one.
    ///
    /// # Errors
    /// Returns the same errors as [`Renderer::set_figure`].
    pub fn set_figure(&mut self, figure: &Figure) -> Result<(), RenderError> {
        self.renderer.set_figure(figure)
    }

    /// Uploads another shape of the figure than `before`, which was uploaded last; its images are
    /// kept.
    ///
    /// # Errors
    /// Returns the same errors as [`Renderer::set_shape`].
    pub fn set_shape(
        &mut self,
        before: &Figure,
        figure: &Figure,
        moves: bool,
    ) -> Result<(), RenderError> {
        self.renderer.set_shape(before, figure, moves)
    }

    /// Sets a decoded RGBA image of the figure by its index.
    ///
    /// # Errors
    /// Returns the same errors as [`Renderer::set_image`].
    pub fn set_image(
        &mut self,
        index: usize,
        width: u32,
        height: u32,
        rgba: &[u8],
    ) -> Result<(), RenderError> {
        self.renderer.set_image(index, width, height, rgba)
    }

    /// Fixes a quality from the next image on; with `None`, it follows frame times.
    pub fn choose(&mut self, quality: Option<Quality>) {
        self.pace.choose(quality);
        self.follow_pace();
    }

    /// Takes the time between two displayed frames, milliseconds; the quality follows it.
    pub fn report_frame(&mut self, ms: f64) {
        // A frame in the old quality does not describe the new one.
        if !self.renderer.is_changing() && self.pace.report(ms) {
            self.renderer.set_options_soon(self.pace.options());
            self.fit();
        }
    }

    /// Sets whether the image is static; a static image is rendered at full size.
    pub fn set_resting(&mut self, resting: bool) {
        self.resting = resting;
        self.fit();
    }

    fn follow_pace(&mut self) {
        self.renderer.set_options(self.pace.options());
        self.fit();
    }

    /// Sets the full image size, clamped to between 1 and the device's limit on either side. The
    /// canvas's own `width` and `height` follow.
    pub fn resize(&mut self, width: u32, height: u32) {
        let limit = self.device.limits().max_texture_dimension_2d;
        self.size = (width.clamp(1, limit), height.clamp(1, limit));
        self.fit();
    }

    fn fit(&mut self) {
        let most_pixels = self.pace.most_pixels().filter(|_| !self.resting);
        let size = within(self.size, most_pixels);
        if size != (self.configuration.width, self.configuration.height) {
            (self.configuration.width, self.configuration.height) = size;
            self.surface.configure(&self.device, &self.configuration);
        }
    }

    /// Renders a frame to the canvas.
    ///
    /// # Errors
    /// Returns an error if the driver rejects the renderer or its calls.
    pub fn render(&mut self, frame: &Frame) -> Result<RenderStatus, RenderError> {
        if self.is_lost() {
            return Ok(RenderStatus::DeviceLost);
        }
        let texture = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(t) | CurrentSurfaceTexture::Suboptimal(t) => t,
            CurrentSurfaceTexture::Timeout | CurrentSurfaceTexture::Occluded => {
                return Ok(RenderStatus::Skipped);
            }
            CurrentSurfaceTexture::Outdated | CurrentSurfaceTexture::Lost => {
                self.surface.configure(&self.device, &self.configuration);
                match self.surface.get_current_texture() {
                    CurrentSurfaceTexture::Success(t) | CurrentSurfaceTexture::Suboptimal(t) => t,
                    _ => return Ok(RenderStatus::Skipped),
                }
            }
            CurrentSurfaceTexture::Validation => {
                return Err(RenderError::Surface(
                    "the browser gave no picture to draw to".to_owned(),
                ));
            }
        };
        let view = texture
            .texture
            .create_view(&wgpu::TextureViewDescriptor::default());
        let size = (self.configuration.width, self.configuration.height);
        self.renderer.render(frame, &view, size)?;
        self.renderer.present(texture);
        Ok(RenderStatus::Drawn)
    }

    fn is_lost(&self) -> bool {
        #[cfg(feature = "webgl")]
        if self
            .context
            .as_ref()
            .is_some_and(web_sys::WebGl2RenderingContext::is_context_lost)
        {
            return true;
        }
        self.lost.load(Ordering::Relaxed)
    }
}

impl Drop for CanvasTarget {
    /// Releases the device and its resources immediately. wgpu does nothing when a WebGPU device is
    /// dropped, and the browser keeps its memory until garbage collection.
    fn drop(&mut self) {
        self.device.destroy();
    }
}

/// Returns a size of the same aspect with at most a number of pixels.
fn within((width, height): (u32, u32), most: Option<u32>) -> (u32, u32) {
    let pixels = f64::from(width) * f64::from(height);
    let scale = most.map_or(1.0, |most| (f64::from(most) / pixels).sqrt().min(1.0));
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "no larger than the size given"
    )]
    let side = |length: u32| (f64::from(length) * scale).round().max(1.0) as u32;
    (side(width), side(height))
}

/// Returns the WebGL2 context that wgpu created for the canvas; a repeated request returns the same
/// one.
#[cfg(feature = "webgl")]
fn webgl_context(canvas: &web_sys::HtmlCanvasElement) -> Option<web_sys::WebGl2RenderingContext> {
    use wasm_bindgen::JsCast;
    canvas.get_context("webgl2").ok()??.dyn_into().ok()
}
