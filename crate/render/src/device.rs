//! Opening of a device, with or without a window.

use crate::RenderError;

/// Opens an available adapter (one that can present to `surface`, if given) and a device of it.
pub(crate) async fn open(
    instance: &wgpu::Instance,
    surface: Option<&wgpu::Surface<'_>>,
) -> Result<(wgpu::Adapter, wgpu::Device, wgpu::Queue), RenderError> {
    let adapter = instance
        .request_adapter(&wgpu::RequestAdapterOptions {
            compatible_surface: surface,
            ..Default::default()
        })
        .await
        .map_err(|e| RenderError::NoAdapter(e.to_string()))?;
    let (device, queue) = adapter
        .request_device(&wgpu::DeviceDescriptor {
            // The lowest sufficient limits, so that any device works, with the adapter's own limit
            // on the size of images.
            required_limits: wgpu::Limits::downlevel_webgl2_defaults()
                .using_resolution(adapter.limits()),
            ..Default::default()
        })
        .await
        .map_err(|e| RenderError::NoDevice(e.to_string()))?;
    Ok((adapter, device, queue))
}

/// Returns true for a software renderer. Browsers report only the name, and some not even that.
pub(crate) fn is_software(adapter: &wgpu::AdapterInfo) -> bool {
    const NAMES: [&str; 4] = [
        "llvmpipe",
        "softpipe",
        "swiftshader",
        "microsoft basic render",
    ];
    let name = adapter.name.to_lowercase();
    adapter.device_type == wgpu::DeviceType::Cpu || NAMES.iter().any(|n| name.contains(n))
}
