//! Rendering without a screen.

use raconteur_body::Figure;
use raconteur_stage::Frame;

use crate::{RenderError, RenderInfo, RenderOptions, Renderer};

/// Renderer with its own device and no window, for images in memory.
///
/// # Examples
///
/// ```no_run
/// use raconteur_render::{Headless, RenderOptions};
/// use raconteur_stage::Frame;
///
/// # fn example(figure: &raconteur_body::Figure) -> Result<(), Box<dyn std::error::Error>> {
/// let mut headless = Headless::new_blocking(RenderOptions::default())?;
/// headless.set_figure(figure)?;
/// let frame = Frame::with_capacity(figure.skeleton.joints().len(), figure.morph_names.len());
/// let rgba = headless.render_rgba(&frame, 640, 360)?;
/// assert_eq!(rgba.len(), 4 * 640 * 360);
/// # Ok(())
/// # }
/// ```
pub struct Headless {
    device: wgpu::Device,
    queue: wgpu::Queue,
    renderer: Renderer,
    canvas: Option<Canvas>,
}

/// Target and read-back of one size.
struct Canvas {
    size: (u32, u32),
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    read_back: wgpu::Buffer,
    row_bytes: u32,
}

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

impl Headless {
    /// Opens the first available adapter, including software, and creates a renderer.
    ///
    /// # Errors
    /// Returns an error if there is no adapter, or the adapter provides no device.
    pub async fn new(options: RenderOptions) -> Result<Self, RenderError> {
        let instance = wgpu::Instance::default();
        let (adapter, device, queue) = crate::device::open(&instance, None).await?;
        let renderer = Renderer::new(&adapter, device.clone(), queue.clone(), FORMAT, options);
        Ok(Self {
            device,
            queue,
            renderer,
            canvas: None,
        })
    }

    /// Opens an adapter like [`Self::new`] and blocks until it is ready.
    ///
    /// # Errors
    /// Returns the same errors as [`Self::new`].
    pub fn new_blocking(options: RenderOptions) -> Result<Self, RenderError> {
        pollster::block_on(Self::new(options))
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

    /// Sets the rendering options, which apply from the next image on.
    pub fn set_options(&mut self, options: RenderOptions) {
        self.renderer.set_options(options);
    }

    /// Sets the options like [`Self::set_options`], compiling one program per image until complete.
    pub fn set_options_soon(&mut self, options: RenderOptions) {
        self.renderer.set_options_soon(options);
    }

    /// Draws a frame; returns sRGB bytes, RGBA, rows from the top without padding.
    ///
    /// # Errors
    /// Returns an error if the size cannot be rendered, the driver rejects a call, or reading back
    /// fails.
    pub fn render_rgba(
        &mut self,
        frame: &Frame,
        width: u32,
        height: u32,
    ) -> Result<Vec<u8>, RenderError> {
        let limit = self.device.limits().max_texture_dimension_2d;
        if width == 0 || height == 0 || width > limit || height > limit {
            return Err(RenderError::BadSize {
                width,
                height,
                limit,
            });
        }
        if self
            .canvas
            .as_ref()
            .is_none_or(|c| c.size != (width, height))
        {
            self.canvas = Some(Canvas::new(&self.device, (width, height)));
        }
        let Some(canvas) = &self.canvas else {
            return Err(RenderError::DeviceLost);
        };
        self.renderer.render(frame, &canvas.view, canvas.size)?;
        canvas.read(&self.device, &self.queue)
    }
}

impl Canvas {
    fn new(device: &wgpu::Device, size: (u32, u32)) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("canvas"),
            size: wgpu::Extent3d {
                width: size.0,
                height: size.1,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let row_bytes = (4 * size.0).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let read_back = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read back"),
            size: u64::from(row_bytes) * u64::from(size.1),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self {
            size,
            texture,
            view,
            read_back,
            row_bytes,
        }
    }

    fn read(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Vec<u8>, RenderError> {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.read_back,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.row_bytes),
                    rows_per_image: None,
                },
            },
            self.texture.size(),
        );
        queue.submit([encoder.finish()]);
        let (sender, receiver) = std::sync::mpsc::channel();
        self.read_back
            .map_async(wgpu::MapMode::Read, .., move |result| {
                // The receiver lives until the answer; it is gone only after an error below.
                let _ = sender.send(result);
            });
        let failed = |e: &dyn std::fmt::Display| RenderError::ReadBack(e.to_string());
        device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|e| failed(&e))?;
        receiver
            .recv()
            .map_err(|e| failed(&e))?
            .map_err(|e| failed(&e))?;
        let mut out = Vec::with_capacity((4 * self.size.0 * self.size.1) as usize);
        {
            let bytes = self
                .read_back
                .get_mapped_range(..)
                .map_err(|e| failed(&e))?;
            for row in bytes.chunks_exact(self.row_bytes as usize) {
                out.extend_from_slice(&row[..4 * self.size.0 as usize]);
            }
        }
        self.read_back.unmap();
        Ok(out)
    }
}
