// The last pass: tone curve, sRGB encoding and dithering. Also smooths edges if the frame has one
// sample per pixel.

@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var picture_sampler: sampler;

// 1: one sample per pixel, so edges are smoothed here.
override SMOOTH_EDGES: u32 = 0u;
// 1: the target encodes sRGB itself.
override TARGET_ENCODES: u32 = 0u;

@vertex
fn vs_tone_map(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

struct StillOut {
    @builtin(position) clip: vec4<f32>,
    // Position in the still and its divisor: both are linear in the image.
    @location(0) place: vec3<f32>,
};

// The previously rendered backdrop, behind everything, reprojected to the current rotation and zoom
// of the camera.
@vertex
fn vs_still(@builtin(vertex_index) i: u32) -> StillOut {
    let q = vec2<f32>(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0);
    let ray = frame.ray_forward.xyz + frame.ray_right.xyz * q.x + frame.ray_up.xyz * q.y;
    let place = vec3<f32>(dot(ray, frame.still[0].xyz), dot(ray, frame.still[1].xyz), dot(ray, frame.still[2].xyz));
    return StillOut(vec4<f32>(q, 1.0, 1.0), place);
}

@fragment
fn fs_still(v: StillOut) -> @location(0) vec4<f32> {
    if frame.still[2].w == 1.0 {
        return textureLoad(picture, vec2<i32>(v.clip.xy), 0);
    }
    let q = v.place.xy / v.place.z;
    return textureSampleLevel(picture, picture_sampler, vec2<f32>(0.5 + 0.5 * q.x, 0.5 - 0.5 * q.y), 0.0);
}

fn light_at(uv: vec2<f32>) -> vec3<f32> {
    return textureSampleLevel(picture, picture_sampler, uv, 0.0).rgb;
}

// Luma for edge detection: a cheap approximation of the encoded output.
fn luma(light: vec3<f32>) -> f32 {
    let y = max(dot(light, vec3<f32>(0.299, 0.587, 0.114)), 0.0);
    if EARLY_ENCODE == 1u {
        return y;
    }
    return sqrt(y / (0.35 + y));
}

// Blends along edges detected from four diagonal neighbours (Lottes 2009, FXAA, the console
// variant).
fn smoothed(uv: vec2<f32>) -> vec3<f32> {
    let px = frame.viewport.zw;
    let middle = light_at(uv);
    let nw = luma(light_at(uv + px * vec2<f32>(-0.5, -0.5)));
    let ne = luma(light_at(uv + px * vec2<f32>(0.5, -0.5)));
    let sw = luma(light_at(uv + px * vec2<f32>(-0.5, 0.5)));
    let se = luma(light_at(uv + px * vec2<f32>(0.5, 0.5)));
    let m = luma(middle);
    let low = min(m, min(min(nw, ne), min(sw, se)));
    let high = max(m, max(max(nw, ne), max(sw, se)));
    if high - low < max(0.03, high * 0.10) {
        return middle;
    }
    var along = vec2<f32>(-((nw + ne) - (sw + se)), (nw + sw) - (ne + se));
    let weakest = min(abs(along.x), abs(along.y)) + (nw + ne + sw + se) * 0.03;
    along = clamp(along / max(weakest, 1e-3), vec2<f32>(-6.0), vec2<f32>(6.0)) * px;
    let near = 0.5 * (light_at(uv - along / 6.0) + light_at(uv + along / 6.0));
    let far = 0.5 * near + 0.25 * (light_at(uv - along * 0.5) + light_at(uv + along * 0.5));
    let l = luma(far);
    return select(far, near, l < low || l > high);
}

@fragment
fn fs_tone_map(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let uv = at.xy * frame.viewport.zw;
    var c: vec3<f32>;
    if SMOOTH_EDGES == 1u {
        c = smoothed(uv);
    } else {
        c = light_at(uv);
    }
    if EARLY_ENCODE == 0u {
        c = srgb_encode(develop(c, at.xy));
    }
    // Half a quantisation step of noise hides banding in the dark backdrop.
    c += (pixel_noise(at.xy) - 0.5) / 255.0;
    if TARGET_ENCODES == 1u {
        let low = c / 12.92;
        let high = pow((max(c, vec3<f32>(0.0)) + 0.055) / 1.055, vec3<f32>(2.4));
        c = select(high, low, c <= vec3<f32>(0.04045));
    }
    return vec4<f32>(clamp(c, vec3<f32>(0.0), vec3<f32>(1.0)), 1.0);
}
