// Light on a surface: the key's shadow, specular lobes, ambient light and the window in eyes.

@group(0) @binding(1) var shadow_map: texture_depth_2d;
@group(0) @binding(2) var shadow_sampler: sampler_comparison;

// Position of a point in a light's shadow map: uv of the light's own square, and depth. Outside the
// map the depth is negative, so the point is lit.
fn in_map(light: u32, p: vec3<f32>) -> vec3<f32> {
    let q = frame.shadow_from_world[light] * vec4<f32>(p, 1.0);
    let uv = vec2<f32>(0.5 + 0.5 * q.x, 0.5 - 0.5 * q.y);
    let inside = all(uv > vec2<f32>(0.004)) && all(uv < vec2<f32>(0.996)) && q.z < 1.0;
    return vec3<f32>(uv, select(-1.0, q.z, inside));
}

// Sample position for a surface point in the shadow map: slightly off the surface, further where
// the surface is edge-on to the light.
fn off_surface(light: u32, p: vec3<f32>, n: vec3<f32>, l: vec3<f32>) -> vec3<f32> {
    return in_map(light, p + n * (frame.shadow.y * (1.4 - saturate1(dot(n, l)))));
}

// Single sample: 1 where the light enters no higher than this depth.
fn lit_at(light: u32, uv: vec2<f32>, depth: f32) -> f32 {
    let at = vec2<f32>((uv.x + f32(light)) / f32(SHADOWS), uv.y);
    return textureSampleCompareLevel(shadow_map, shadow_sampler, at, depth);
}

// Share of lit taps on a disc, evenly distributed on a spiral (Vogel 1979, "A better way to
// construct the sunflower head"). No two taps align in any direction, so a shadow's edge has as
// many steps as there are taps, and banding is invisible. `radius` is in map widths.
fn taps(light: u32, q: vec3<f32>, radius: f32, count: i32, shift: vec2<f32>) -> f32 {
    var sum = 0.0;
    var total = 0.0;
    var way = vec2<f32>(1.0, 0.0);
    for (var i = 0; i < count; i++) {
        let r2 = (f32(i) + 0.5) / f32(count);
        let w = 1.0 - 0.65 * r2;
        sum += w * lit_at(light, q.xy + (way * sqrt(r2) + shift) * radius, q.z);
        total += w;
        // Rotation by the golden angle.
        way = vec2<f32>(-0.7373688 * way.x - 0.6754903 * way.y, 0.6754903 * way.x - 0.7373688 * way.y);
    }
    return sum / total;
}

// A shift by part of a tap hides the remaining steps. A larger shift would be visible as grain,
// because no later frame averages it.
fn tap_shift(at: vec2<f32>) -> vec2<f32> {
    let grain = pixel_noise(at);
    return (vec2<f32>(grain, fract(grain * 7.31 + 0.37)) - 0.5) * 0.12;
}

// Share of the key light that reaches the point, 0..1, at the pixel `at`. Shadows are soft from far
// occluders and sharpen towards contact: occluders within 4 cm towards the lamp are filtered
// narrowly, all others widely.
fn key_share(p: vec3<f32>, n: vec3<f32>, at: vec2<f32>) -> f32 {
    if SHADOWS < 1u {
        return 1.0;
    }
    if SHADOW_REACH < 2 {
        return filtered_share(p, n, at);
    }
    let q = off_surface(0u, p, n, frame.key_dir.xyz) - vec3<f32>(0.0, 0.0, frame.shadow.z);
    let above = q - vec3<f32>(0.0, 0.0, 0.04 * frame.shadow.w);
    let shift = tap_shift(at);
    let far = taps(0u, above, frame.shadow.x * 4.4, 24, shift);
    let near = taps(0u, above, frame.shadow.x * 1.1, 12, shift) - taps(0u, q, frame.shadow.x * 1.1, 12, shift);
    return far * (1.0 - saturate1(near));
}

// The same with a single sample.
fn sharp_share(p: vec3<f32>, n: vec3<f32>) -> f32 {
    if SHADOWS < 1u {
        return 1.0;
    }
    let q = off_surface(0u, p, n, frame.key_dir.xyz) - vec3<f32>(0.0, 0.0, frame.shadow.z);
    return lit_at(0u, q.xy, q.z);
}

fn filtered_share(p: vec3<f32>, n: vec3<f32>, at: vec2<f32>) -> f32 {
    if SHADOWS < 1u {
        return 1.0;
    }
    let q = off_surface(0u, p, n, frame.key_dir.xyz) - vec3<f32>(0.0, 0.0, frame.shadow.z);
    return taps(0u, q, frame.shadow.x * 1.4, 7, tap_shift(at));
}

// Light at a point `lift` metres off the surface: 0 where an occluder other than the surface's own
// curvature blocks it, 0..1 at the edge of such a shadow.
fn lifted_share(light: u32, p: vec3<f32>, n: vec3<f32>, lift: f32, at: vec2<f32>) -> f32 {
    if SHADOWS < 1u {
        return 1.0;
    }
    let q = in_map(light, p + n * lift) - vec3<f32>(0.0, 0.0, frame.shadow.z);
    return taps(light, q, frame.shadow.x * 1.4, 7, tap_shift(at));
}

// Share of the rim light that reaches the point, 0..1; always 1 if only the key has a shadow.
fn rim_share(p: vec3<f32>, n: vec3<f32>, at: vec2<f32>) -> f32 {
    if SHADOWS < 2u {
        return 1.0;
    }
    let q = off_surface(1u, p, n, frame.rim_dir.xyz) - vec3<f32>(0.0, 0.0, frame.shadow.z);
    return taps(1u, q, frame.shadow.x * 1.4, 7, tap_shift(at));
}

// Transmittance of the material between p and the lamp, 0..1: the share of the depths of about 2,
// 3.5, 5.5 and 8 mm within which the light entered. The pixel `at` shifts the steps, so that none
// is visible.
fn thinness(light: u32, p: vec3<f32>, at: vec2<f32>) -> f32 {
    if SHADOWS < 2u {
        return 0.0;
    }
    let q = in_map(light, p);
    let uv = q.xy + tap_shift(at) * frame.shadow.x;
    let mm = (0.85 + 0.3 * pixel_noise(at.yx)) * 0.001 * frame.shadow.w;
    return 0.25 * (lit_at(light, uv, q.z - 2.0 * mm) + lit_at(light, uv, q.z - 3.5 * mm)
        + lit_at(light, uv, q.z - 5.5 * mm) + lit_at(light, uv, q.z - 8.0 * mm));
}

// GGX with the height-correlated Smith term in Hammon's approximation (GDC 2017), times the cosine;
// without Fresnel.
fn specular(n: vec3<f32>, v: vec3<f32>, l: vec3<f32>, roughness: f32) -> f32 {
    let h = normalize(v + l);
    let ndl = saturate1(dot(n, l));
    let ndv = max(dot(n, v), 0.05);
    let ndh = saturate1(dot(n, h));
    let alpha = roughness * roughness;
    let a2 = alpha * alpha;
    let d = ndh * ndh * (a2 - 1.0) + 1.0;
    let visibility = 0.5 / max(mix(2.0 * ndl * ndv, ndl + ndv, alpha), 1e-4);
    return min(a2 / (PI * d * d) * visibility * ndl, 24.0);
}

// Roughness adjusted to the variation of the normal within the pixel, as given by its derivatives:
// a lobe is never narrower than one sample can resolve (Tokuyoshi and Kaplanyan 2019, "Improved
// geometric specular antialiasing", eq. 3 with their variance 0.25 and threshold 0.18). Without it
// a strong curvature lights up single pixels.
fn filtered_roughness(n: vec3<f32>, roughness: f32) -> f32 {
    let dx = dpdx(n);
    let dy = dpdy(n);
    let kernel = min(0.5 * (dot(dx, dx) + dot(dy, dy)), 0.18);
    let alpha = roughness * roughness;
    return sqrt(sqrt(min(alpha * alpha + kernel, 1.0)));
}

fn fresnel(f0: f32, cosine: f32) -> f32 {
    let x = 1.0 - saturate1(cosine);
    let x2 = x * x;
    return f0 + (1.0 - f0) * x2 * x2 * x;
}

// Irradiance over pi of the room, by direction.
fn ambient(n: vec3<f32>) -> vec3<f32> {
    let c = frame.ambient;
    let flat = c[0] + c[1] * n.y + c[2] * n.z + c[3] * n.x;
    let bent = c[4] * (n.x * n.y) + c[5] * (n.y * n.z) + c[6] * (3.0 * n.z * n.z - 1.0)
        + c[7] * (n.x * n.z) + c[8] * (n.x * n.x - n.y * n.y);
    return max((flat + bent).xyz, vec3<f32>(0.0));
}

// Reflection of a smooth surface in a direction: the room, its pale ceiling, and a large soft lamp
// at the key.
fn mirrored(r: vec3<f32>) -> vec3<f32> {
    let lamp = smoothstep(0.55, 1.0, dot(r, frame.key_dir.xyz));
    let ceiling = smoothstep(0.45, 0.8, r.y);
    return ambient(r) * 0.75 + frame.sky.xyz * (0.4 * ceiling) + frame.key.xyz * (0.5 * lamp * lamp);
}

// Visible share of a large round lamp in the direction of a light, along a mirror direction; 0..1.
// `size` is the tangent of its half width. It fades towards its edge like a soft lamp.
fn lamp_share(r: vec3<f32>, l: vec3<f32>, size: f32) -> f32 {
    let facing = dot(r, l);
    let off = length(r - l * facing) / max(facing, 1e-3);
    return select(0.0, smoothstep(1.0, 0.45, off / size), facing > 0.2);
}

// Ambient occlusion as a colour: light bounced within the cavity takes the surface's colour
// (polynomial of Jimenez et al. 2016, "Practical real-time strategies for accurate indirect
// occlusion", eq. 10).
fn tinted_occlusion(ao: f32, albedo: vec3<f32>) -> vec3<f32> {
    let a = 2.0404 * albedo - 0.3324;
    let b = -4.7951 * albedo + 0.6417;
    let c = 2.7552 * albedo + 0.6903;
    // Half of the published tint: skin in deep cavities would glow.
    return mix(vec3<f32>(ao), max(vec3<f32>(ao), ((ao * a + b) * ao + c) * ao), 0.6);
}
