// Functions of the sets fireside, garden, night and school. Like the curtain, the sets are ray-cast
// per pixel, without triangles; each has its own fragment shader. All shapes and factors are chosen
// by eye. Colours come only from the set's uniforms, so that a tint affects everything.

// Diameter of the lens, metres; determines the blur behind the speaker.
const APERTURE = 0.023;

// Half the width of a blurred edge at this distance, metres; at least one pixel.
fn edge_blur(distance: f32) -> f32 {
    let focus = max(length(frame.eye_in_world.xz - frame.stand.xz), 1.0);
    return APERTURE * abs(distance / focus - 1.0) + distance * frame.viewport.w;
}

// The same at infinity, radians.
fn far_blur() -> f32 {
    let focus = max(length(frame.eye_in_world.xz - frame.stand.xz), 1.0);
    return APERTURE / focus + 0.6 * frame.viewport.w;
}

// 1 within `half` of 0, with soft edges.
fn within(x: f32, half: f32, blur: f32) -> f32 {
    return smoothstep(-blur, blur, half - abs(x));
}

fn within_box(p: vec2<f32>, half: vec2<f32>, blur: f32) -> f32 {
    return within(p.x, half.x, blur) * within(p.y, half.y, blur);
}

// Value noise on a plane, 0..1.
fn patches(p: vec2<f32>) -> f32 {
    let cell = floor(p);
    let f = p - cell;
    let i = vec3<i32>(vec2<i32>(cell), 5);
    let lo = lattice(i);
    let hi = lattice(i + 1);
    let u = f * f * (3.0 - 2.0 * f);
    let low = mix(mixed(lo.x ^ lo.y ^ lo.z), mixed(hi.x ^ lo.y ^ lo.z), u.x);
    let high = mix(mixed(lo.x ^ hi.y ^ lo.z), mixed(hi.x ^ hi.y ^ lo.z), u.x);
    return mix(low, high, u.y);
}

// Defocused lights: a disc in some cells of a grid, with its coverage and brightness.
fn discs(p: vec2<f32>, cell: f32, radius: f32, blur: f32, seed: i32) -> f32 {
    let q = p / cell;
    let c = floor(q);
    let i = vec3<i32>(vec2<i32>(c), seed);
    let play = max(0.5 - (radius + blur) / cell, 0.0);
    let at = vec2<f32>(hash_unit(i), hash_unit(i + vec3<i32>(0, 0, 57))) * 2.0 - 1.0;
    let shine = hash_unit(i + vec3<i32>(0, 0, 91));
    let d = length(q - c - 0.5 - at * play) * cell;
    return smoothstep(radius + blur, radius - blur, d) * smoothstep(0.45, 1.0, shine);
}

// Light on the floor; `even` is 0 in a pool of light and 1 under an open sky.
fn floor_light(p: vec3<f32>, at: vec2<f32>, even: f32) -> vec3<f32> {
    let from_stand = p.xz - frame.stand.xz;
    let r2 = dot(from_stand, from_stand);
    let pool = mix(exp(-r2 * 0.55), 1.0, even);
    // A light source as wide as a hearth or a window leaves half of its light in a shadow on the
    // floor.
    let share = 0.55 + 0.45 * key_share(p, vec3<f32>(0.0, 1.0, 0.0), at);
    let body = 1.0 - 0.35 * exp(-r2 / 0.10);
    return frame.key.xyz * (frame.key_dir.y * share * (0.10 + 0.95 * pool))
        + frame.sky.xyz * ((0.25 + 0.45 * pool) * contact_shade(p, 0.62) * body);
}

fn floor_time(ray: vec3<f32>) -> f32 {
    let eye = frame.eye_in_world.xyz;
    return select(1e9, -eye.y / ray.y, ray.y < -1e-6 && eye.y > 0.0);
}

// Intersection with the wall of a room: the point in xyz, x unrolled around the corners; the ray
// parameter in w.
fn room_wall(ray: vec3<f32>, back: f32, half: f32) -> vec4<f32> {
    let eye = frame.eye_in_world.xyz;
    let rx = select(ray.x, 1e-5, abs(ray.x) < 1e-5);
    let rz = select(ray.z, 1e-5, abs(ray.z) < 1e-5);
    let t_back = (select(30.0, back, rz < 0.0) - eye.z) / rz;
    let t_side = (half * sign(rx) - eye.x) / rx;
    let first = min(t_back, t_side);
    let t = select(60.0, first, first > 0.0);
    let p = eye + ray * t;
    let u = p.x + select(0.0, sign(rx) * (p.z - back), t_side < t_back);
    return vec4<f32>(u, p.yz, t);
}

// Ray parameter at the exit from a round wall whose centre is `middle` metres in front of the
// stage's centre.
fn round_time(ray: vec3<f32>, middle: f32, radius: f32) -> f32 {
    let o = frame.eye_in_world.xz - vec2<f32>(0.0, middle);
    let a = max(dot(ray.xz, ray.xz), 1e-8);
    let b = dot(o, ray.xz);
    let c = dot(o, o) - radius * radius;
    return (-b + sqrt(max(b * b - a * c, 0.0))) / a;
}

// Time of the set's animation, seconds; 0 for a still set.
fn set_time() -> f32 { return frame.eye_in_world.w; }

// Distance of a point from a line segment, metres.
fn from_piece(p: vec2<f32>, a: vec2<f32>, b: vec2<f32>) -> f32 {
    let ab = b - a;
    return length(p - a - ab * saturate1(dot(p - a, ab) / max(dot(ab, ab), 1e-8)));
}

// 1 on a line of this half width, with soft edges; a line thinner than its blur fades.
fn drawn(distance: f32, half: f32, blur: f32) -> f32 {
    return smoothstep(half + blur, half - blur, distance) * min(1.0, 0.4 + half / max(blur, 1e-4));
}

// Intersection of the ray with an upright plane at `z` in front of the wall: point in xy, ray
// parameter in z. The parameter is negative without an intersection.
fn upright(ray: vec3<f32>, z: f32) -> vec3<f32> {
    let eye = frame.eye_in_world.xyz;
    let t = (z - eye.z) / min(ray.z, -1e-4);
    let met = ray.z < -1e-4 && eye.z > z + 0.3;
    return vec3<f32>((eye + ray * t).xy, select(-1.0, t, met));
}

// Leaves on an upright plane: three layers of swaying blades. `there` is their density at the
// point, 0..1. Returns the share of green in x, the share of sunlight through them in y, and the
// coverage in z.
fn foliage(p: vec2<f32>, there: f32, blur: f32) -> vec3<f32> {
    var seen = vec3<f32>(0.0);
    let t = set_time();
    // Rotated against the edges of the image, so that no rows appear.
    let leaning = mat2x2<f32>(0.80, 0.60, -0.60, 0.80);
    for (var i = 0; i < 3; i++) {
        let f = f32(i);
        let sway = vec2<f32>(0.012, 0.006) * sin(t * vec2<f32>(1.1, 1.7) + f * 2.1 + p.x * 2.0);
        let q = leaning * (p + sway) * (11.0 + 2.5 * f) + f * vec2<f32>(3.7, 8.1);
        let cell = floor(q);
        let id = vec3<i32>(vec2<i32>(cell), i + 40);
        let turn = 6.28 * hash_unit(id);
        let bright = hash_unit(id + vec3<i32>(0, 0, 5));
        let along = vec2<f32>(cos(turn), sin(turn));
        let d = q - cell - 0.5 - 0.10 * vec2<f32>(along.y, along.x);
        let l = vec2<f32>(dot(d, along), dot(d, vec2<f32>(-along.y, along.x)));
        let b = min(blur * (11.0 + 2.5 * f), 0.17);
        // A blurred leaf must not extend beyond its cell.
        // Leaves are small at low density, so none is cut in two.
        let grown = smoothstep(0.0, 0.12, there - hash_unit(id + vec3<i32>(0, 0, 9)));
        let half = (0.33 - 0.4 * b) * grown;
        let blade = smoothstep(half + b, half - b, length(l * vec2<f32>(1.0, 1.9 + 1.2 * l.x)));
        seen = mix(seen, vec3<f32>(0.7 + 0.9 * bright, bright * bright, 1.0), blade * smoothstep(0.0, 0.3, grown));
    }
    // Tones are blended over nothing, so they are weighted by their coverage.
    return vec3<f32>(seen.xy / max(seen.z, 1e-3), seen.z);
}
