// Uniforms shared by every pass of a frame, and utilities: noise, tone curve, encoding.

struct Frame {
    clip_from_world: mat4x4<f32>,
    shadow_from_world: array<mat4x4<f32>, 2>, // key, rim
    // World directions through the centre of the image, and half an image right and up; for the
    // backdrop.
    ray_forward: vec4<f32>,
    ray_right: vec4<f32>,
    ray_up: vec4<f32>,
    eye_in_world: vec4<f32>,   // w: time of the animation of fire and leaves, seconds
    key_dir: vec4<f32>,
    key: vec4<f32>,
    fill_dir: vec4<f32>,
    fill: vec4<f32>,
    rim_dir: vec4<f32>,
    rim: vec4<f32>,
    sky: vec4<f32>,
    ground: vec4<f32>,         // w: exposure
    floor: vec4<f32>,
    backdrop_low: vec4<f32>,   // w: number of the set, 0 in a studio, 1 at the curtain
    backdrop_high: vec4<f32>,
    glow: vec4<f32>,
    fog: vec4<f32>,            // w: density per metre beyond the figure
    stand: vec4<f32>,          // position of the figure, w: stature, metres
    feet: array<vec4<f32>, 2>, // left and right soles, world
    shadow: vec4<f32>,         // x: tap distance in uv, y: normal offset in metres, z: depth bias,
                               // w: depth per metre
    viewport: vec4<f32>,       // width, height, 1/width, 1/height
    ambient: array<vec4<f32>, 9>, // irradiance over pi, spherical harmonics by factor of the basis
    head_up: vec4<f32>,        // w: distance of the camera's target, metres
    eyes: vec4<f32>,           // x: radius of the pupil relative to the globe,
                               // y: distance between the lips, mm
    // Planes through the centre of the eye and the edge of each lid, with normals towards the
    // covered side: upper and lower, left eye, then right; 0 without a lid.
    lids: array<vec4<f32>, 4>,
    // Position of a ray in the still of the backdrop: across, up, and their common divisor. w of
    // the first: width of the still being rendered, relative to the image. w of the last: 1 if the
    // still belongs to exactly this image.
    still: array<vec4<f32>, 3>,
};

@group(0) @binding(0) var<uniform> frame: Frame;

// 1: the material shaders apply the tone curve and the encoding (no float target).
override EARLY_ENCODE: u32 = 0u;
// 1: lowest quality, with a cheap approximation of the output encoding.
override SIMPLE: u32 = 0u;
// 1: pores, weave and fibres are computed.
override FINE_DETAIL: u32 = 1u;
// Shadow filter: 1 is a disc of 7 taps, 2 a disc of 24 taps that sharpens towards contact.
override SHADOW_REACH: i32 = 1;
// Number of lights with a shadow: the key, then the rim; their maps are side by side.
override SHADOWS: u32 = 2u;

const PI = 3.14159265;

fn saturate1(x: f32) -> f32 { return clamp(x, 0.0, 1.0); }

// Contribution of a lattice coordinate to a hash (spatial hash of Teschner et al. 2003, "Optimized
// spatial hashing for collision detection of deformable objects").
fn lattice(p: vec3<i32>) -> vec3<u32> {
    return bitcast<vec3<u32>>(p) * vec3<u32>(73856093u, 19349663u, 83492791u);
}

// Maps a hash to a number in 0..1 (multiply-xorshift finaliser after MurmurHash3).
fn mixed(key: u32) -> f32 {
    var h = key ^ (key >> 16u);
    h *= 0x85ebca6bu;
    h ^= h >> 13u;
    h *= 0xc2b2ae35u;
    return f32(h >> 8u) / 16777216.0;
}

fn hash_unit(p: vec3<i32>) -> f32 {
    let q = lattice(p);
    return mixed(q.x ^ q.y ^ q.z);
}

// Value noise in 0..1 (w) with its gradient (xyz) per unit of p.
fn noise_gradient(p: vec3<f32>) -> vec4<f32> {
    let cell = floor(p);
    let f = p - cell;
    let i = vec3<i32>(cell);
    let lo = lattice(i);
    let hi = lattice(i + 1);
    let u = f * f * (3.0 - 2.0 * f);
    let du = 6.0 * f * (1.0 - f);
    let a = mixed(lo.x ^ lo.y ^ lo.z);
    let b = mixed(hi.x ^ lo.y ^ lo.z);
    let c = mixed(lo.x ^ hi.y ^ lo.z);
    let d = mixed(hi.x ^ hi.y ^ lo.z);
    let e = mixed(lo.x ^ lo.y ^ hi.z);
    let g = mixed(hi.x ^ lo.y ^ hi.z);
    let h = mixed(lo.x ^ hi.y ^ hi.z);
    let k = mixed(hi.x ^ hi.y ^ hi.z);
    let k1 = b - a;
    let k2 = c - a;
    let k3 = e - a;
    let k4 = a - b - c + d;
    let k5 = a - c - e + h;
    let k6 = a - b - e + g;
    let k7 = b + c + e + k - a - d - g - h;
    let value = a + k1 * u.x + k2 * u.y + k3 * u.z
        + k4 * u.x * u.y + k5 * u.y * u.z + k6 * u.z * u.x + k7 * u.x * u.y * u.z;
    let slope = du * vec3<f32>(
        k1 + k4 * u.y + k6 * u.z + k7 * u.y * u.z,
        k2 + k5 * u.z + k4 * u.x + k7 * u.z * u.x,
        k3 + k6 * u.x + k5 * u.y + k7 * u.x * u.y);
    return vec4<f32>(slope, value);
}

fn noise(p: vec3<f32>) -> f32 { return noise_gradient(p).w; }

// Interleaved gradient noise of the pixel, 0..1 (Jimenez 2014, "Next generation post processing in
// Call of Duty: Advanced Warfare").
fn pixel_noise(pixel: vec2<f32>) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715))));
}

// Display curve of Uchimura 2017 ("HDR theory and practice", CEDEC): a toe, a linear middle that
// preserves colours, and a shoulder towards 1. Contrast 1.12, linear part from 0.18 over 0.36;
// chosen by eye. Continuous and monotone.
fn tone_curve(x: vec3<f32>) -> vec3<f32> {
    let a = 1.12;
    let m = 0.18;
    let l = 0.36;
    let c = 1.25;
    let l0 = (1.0 - m) * l / a;
    let s0 = m + l0;
    let s1 = m + a * l0;
    let c2 = a / (1.0 - s1);
    let toe_weight = 1.0 - smoothstep(vec3<f32>(0.0), vec3<f32>(m), x);
    let shoulder_weight = step(vec3<f32>(s0), x);
    let toe = m * pow(max(x, vec3<f32>(0.0)) / m, vec3<f32>(c));
    let line = m + a * (x - m);
    let shoulder = 1.0 - (1.0 - s1) * exp(-c2 * (x - s0));
    return toe * toe_weight + line * (1.0 - toe_weight - shoulder_weight)
        + shoulder * shoulder_weight;
}

fn srgb_encode(x: vec3<f32>) -> vec3<f32> {
    let low = 12.92 * x;
    let high = 1.055 * pow(max(x, vec3<f32>(0.0031308)), vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(high, low, x <= vec3<f32>(0.0031308));
}

// Converts scene light to display light: exposure, vignette, tone curve.
fn develop(light: vec3<f32>, pixel: vec2<f32>) -> vec3<f32> {
    let from_middle = (pixel * frame.viewport.zw - 0.5) * 2.0;
    let vignette = 1.0 - 0.16 * smoothstep(0.25, 2.0, dot(from_middle, from_middle));
    return tone_curve(max(light, vec3<f32>(0.0)) * (frame.ground.w * vignette));
}

// Approximates `develop` and `srgb_encode` without the vignette, to 0.03 of the full range: a
// rational function of the root (fitted over 0..6 by least squares), at the cost of one root.
fn encoded_simply(light: vec3<f32>) -> vec3<f32> {
    let s = sqrt(max(light, vec3<f32>(0.0)) * frame.ground.w);
    return saturate(s * (0.63272 + 1.04545 * s) / (1.0 + s * (1.42744 * s - 0.61221)));
}

// Output value of a material for a scene light.
fn written(light: vec3<f32>, alpha: f32, pixel: vec2<f32>) -> vec4<f32> {
    if SIMPLE == 1u {
        return vec4<f32>(encoded_simply(light), alpha);
    }
    if EARLY_ENCODE == 1u {
        return vec4<f32>(srgb_encode(develop(light, pixel)), alpha);
    }
    // The float target overflows at 65504; the limit keeps single bright fragments finite.
    return vec4<f32>(min(light, vec3<f32>(60.0)), alpha);
}
