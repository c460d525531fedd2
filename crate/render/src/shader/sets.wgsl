// Places beside the theatre: fireside, garden, night and school. As the curtain they are found
// by casting the pixel's ray, without triangles; each has a fragment shader of its own. All
// shapes and factors are designed by eye; colours come from the set's alone, so that a tint
// reaches everything.

// Diameter of the lens, metres: what is behind the speaker is out of focus by as much.
const APERTURE = 0.034;

// Half the width of an edge at a place this far off, metres, as the lens blurs it; a pixel at least.
fn edge_blur(distance: f32) -> f32 {
    let focus = max(length(frame.eye_in_world.xz - frame.stand.xz), 1.0);
    return APERTURE * abs(distance / focus - 1.0) + distance * frame.viewport.w;
}

// The same far away, radians.
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

// Lights out of focus: in some cells of a grid a disc, its share and brightness.
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

// What reaches the floor; `even` is 0 in a pool of light and 1 under an open sky.
fn floor_light(p: vec3<f32>, at: vec2<f32>, even: f32) -> vec3<f32> {
    let from_stand = p.xz - frame.stand.xz;
    let r2 = dot(from_stand, from_stand);
    let pool = mix(exp(-r2 * 0.55), 1.0, even);
    let share = key_share(p, vec3<f32>(0.0, 1.0, 0.0), at);
    let body = 1.0 - 0.35 * exp(-r2 / 0.10);
    return frame.key.xyz * (frame.key_dir.y * share * (0.10 + 0.95 * pool))
        + frame.sky.xyz * ((0.25 + 0.45 * pool) * contact_shade(p, 0.62) * body);
}

fn floor_time(ray: vec3<f32>) -> f32 {
    let eye = frame.eye_in_world.xyz;
    return select(1e9, -eye.y / ray.y, ray.y < -1e-6 && eye.y > 0.0);
}

// The wall of a room: the place in xyz, x unrolled around the corners; in w the ray's time.
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

// Where the ray leaves a round wall whose middle lies `middle` metres before the stage's.
fn round_time(ray: vec3<f32>, middle: f32, radius: f32) -> f32 {
    let o = frame.eye_in_world.xz - vec2<f32>(0.0, middle);
    let a = max(dot(ray.xz, ray.xz), 1e-8);
    let b = dot(o, ray.xz);
    let c = dot(o, o) - radius * radius;
    return (-b + sqrt(max(b * b - a * c, 0.0))) / a;
}

const HEARTH_X = -1.0;

// Wall of dark wood, and a chimney of stone with its hearth.
fn hearth_wall(u: f32, y: f32, blur: f32) -> vec3<f32> {
    let low = frame.backdrop_low.xyz;
    let x = u - HEARTH_X;
    // Panels between broad posts, a rail at the height of a chair's back.
    let post = abs(fract(u / 0.62 + 0.5) - 0.5) * 0.62;
    let frame_of = max(1.0 - smoothstep(0.03, 0.05 + 1.5 * blur, post), within(y - 0.98, 0.035, 1.5 * blur));
    var light = mix(low, frame.backdrop_high.xyz, smoothstep(0.2, 2.4, y)) * (0.62 + 0.5 * frame_of);
    // Firelight on the room.
    let q = vec2<f32>(x * 0.55, (y - 0.75) * 0.75);
    let warm = exp(-dot(q, q));
    light += frame.glow.xyz * (0.10 * warm * (0.7 + 0.6 * frame_of));
    // Rough stones, each of its own tone.
    let s = vec2<f32>(0.96 * u + 0.28 * y, 0.96 * y - 0.28 * u);
    let stone = 0.08 + 0.84 * (0.6 * patches(s * vec2<f32>(4.6, 7.5)) + 0.4 * patches(s.yx * vec2<f32>(13.0, 9.0)));
    let breast = within(x, 0.78, blur);
    light = mix(light, (low * 1.15 + frame.glow.xyz * (0.24 * warm)) * (0.45 + 1.0 * stone), breast);
    // The opening over a raised stone: an arch, black with soot, flames on its floor.
    let arch = 1.00 - 0.50 * x * x;
    let open = within(x, 0.42, blur) * within(y - 0.5 * (arch + 0.26), 0.5 * (arch - 0.26), blur);
    light = mix(light, low * 0.12 + fire(x, y - 0.26, blur), open);
    let slab = within_box(vec2<f32>(x, y - 0.13), vec2<f32>(0.86, 0.13), blur);
    light = mix(light, (low * 1.5 + frame.glow.xyz * (0.30 * warm)) * (0.7 + 0.5 * stone), slab);
    // The shelf above, lit from below, and its shadow.
    let shelf = within_box(vec2<f32>(x, y - 1.26), vec2<f32>(0.88, 0.05), blur);
    let under = within(x, 0.85, 2.0 * blur) * smoothstep(0.30, 0.0, y - 1.26) * step(1.26, y);
    light *= 1.0 - 0.45 * under;
    return mix(light, frame.floor.xyz * 0.50 + frame.glow.xyz * (0.20 * exp(-3.0 * x * x)), shelf);
}

// Flames and the glow about them, from the middle of the hearth's floor.
fn fire(x: f32, y: f32, blur: f32) -> vec3<f32> {
    // Three tongues, narrower upwards.
    let b = 1.0 + 6.0 * blur;
    let wide = max(0.15 - 0.12 * y, 0.02) * b;
    let lean = 0.03 * sin(y * 9.0 + 0.5);
    let a = vec3<f32>(x - lean, x + 0.15 + 0.5 * lean, x - 0.16 + lean) / (wide * vec3<f32>(1.0, 0.75, 0.8));
    let tall = vec3<f32>(y) / (vec3<f32>(0.46, 0.30, 0.33) * b);
    let flame = exp(-a * a - tall * tall * tall * tall);
    let heat = max(flame.x, max(flame.y, flame.z)) + 0.35 * (flame.x + flame.y + flame.z);
    let g = vec2<f32>(x / 0.40, (y - 0.05) / 0.42);
    let red = frame.glow.xyz * (1.0 * exp(-dot(g, g)) + 0.9 * heat);
    let bed = exp(-x * x * 11.0 - y * y * 90.0);
    let white = 0.75 * heat * heat * saturate1(1.15 - 1.5 * y) + 0.7 * bed;
    return red + frame.glow.xyz * vec3<f32>(1.0, 2.2, 2.2) * white;
}

fn hearth_floor(p: vec3<f32>, distance: f32, at: vec2<f32>) -> vec3<f32> {
    let px = distance * frame.viewport.w * 1.2;
    let blur = edge_blur(distance);
    let plank = planks(p, px + blur);
    var tone = frame.floor.xyz * plank.x;
    // A round rug with two rings.
    let r = length((p.xz - vec2<f32>(0.05, -0.25)) * vec2<f32>(0.74, 1.0));
    let rug = smoothstep(px + blur, -px - blur, r - 0.92);
    let ring = within(r - 0.80, 0.035, px + blur) + 0.7 * within(r - 0.66, 0.014, px + blur);
    let cloth = frame.floor.xyz * mix(vec3<f32>(0.85, 0.42, 0.46), vec3<f32>(1.35, 1.30, 1.15), ring);
    tone = mix(tone, cloth * (0.9 + 0.2 * patches(p.xz * 9.0)), rug);
    var light = tone * floor_light(p, at, 0.12);
    // The fire's light lies before the hearth.
    let d = (p.xz - vec2<f32>(HEARTH_X, -2.3)) * vec2<f32>(0.95, 0.70);
    light += frame.glow.xyz * (tone / max(frame.floor.xyz, vec3<f32>(1e-4))) * (0.55 * exp(-dot(d, d)));
    return light * mix(1.0, 0.6, smoothstep(2.4, 4.0, length(p.xz)));
}

@fragment
fn fs_fireside(v: TheatreOut) -> @location(0) vec4<f32> {
    let wall = room_wall(v.ray, -2.7, 3.3);
    let t_floor = floor_time(v.ray);
    let distance = min(t_floor, wall.w) * length(v.ray);
    var light: vec3<f32>;
    if t_floor < wall.w {
        light = hearth_floor(frame.eye_in_world.xyz + v.ray * t_floor, distance, v.clip.xy);
    } else {
        light = hearth_wall(wall.x, wall.y, edge_blur(distance)) * mix(1.0, 0.4, smoothstep(1.2, 3.6, abs(wall.x)));
    }
    return written(fogged(light, distance), 1.0, v.clip.xy);
}

// Grass: tone about 1.
fn grass(p: vec3<f32>, px: f32) -> f32 {
    let broad = patches(vec2<f32>(0.8 * p.x + 0.6 * p.z, 0.8 * p.z - 0.6 * p.x) * 1.7);
    let fine = patches(p.xz * vec2<f32>(52.0, 21.0)) - 0.5;
    let seen = 1.0 - smoothstep(0.4, 2.0, px / 0.02);
    return 0.82 + 0.36 * broad + 0.9 * fine * seen;
}

// Trees and sky, by direction: around in x, upwards in y, radians.
fn trees(q: vec2<f32>, blur: f32) -> vec3<f32> {
    let low = frame.backdrop_low.xyz;
    let broad = patches(q * vec2<f32>(13.0, 17.0) + 3.3);
    let leaves = patches(q * 46.0);
    // Crowns of several heights; between them the sky.
    let crown = 0.085 + 0.10 * patches(vec2<f32>(q.x * 7.0 + 0.4, 0.5)) + 0.05 * (broad - 0.5) + 0.02 * (leaves - 0.5);
    let cover = smoothstep(-1.6 * blur - 0.004, 1.6 * blur + 0.004, crown - q.y);
    let sky = frame.backdrop_high.xyz * mix(vec3<f32>(1.0), vec3<f32>(0.80, 0.88, 0.98), saturate1(q.y * 4.0));
    // Light comes through from above.
    let thin = smoothstep(0.12, 0.0, crown - q.y);
    var leaf = low * (0.55 + 0.75 * broad + 0.30 * leaves) + frame.glow.xyz * (0.04 + 0.13 * thin) * (0.35 + broad);
    let radius = min(0.6 * blur + 0.004, 0.013);
    let shine = 0.8 * discs(q, 0.034, radius * 0.8, 0.35 * radius, 11)
        + discs(q + 0.017, 0.061, radius * 1.5, 0.4 * radius, 12);
    leaf += frame.glow.xyz * (shine * (0.07 + 0.38 * thin) * smoothstep(0.0, 0.07, q.y));
    return mix(sky, leaf, cover);
}

@fragment
fn fs_garden(v: TheatreOut) -> @location(0) vec4<f32> {
    let eye = frame.eye_in_world.xyz;
    let level = max(length(v.ray.xz), 1e-4);
    let q = vec2<f32>(atan2(v.ray.x, -v.ray.z), v.ray.y / level);
    let t_floor = floor_time(v.ray);
    let t_hedge = round_time(v.ray, 7.0, 12.6);
    let scale = length(v.ray);
    let p = eye + v.ray * min(t_floor, t_hedge);
    let distance = min(t_floor, t_hedge) * scale;
    let blur = edge_blur(distance);
    var light: vec3<f32>;
    if t_floor < t_hedge {
        let px = distance * frame.viewport.w * 1.2 + blur;
        light = frame.floor.xyz * (grass(p, px) * floor_light(p, v.clip.xy, 0.72));
        // Dapples; under the hedge it is as dark as the hedge's foot.
        light *= 0.72 + 0.62 * smoothstep(0.15, 0.95, patches(vec2<f32>(0.6 * p.x - 0.8 * p.z, 0.9 * p.z) * 0.9 + 2.0));
        let from_hedge = 12.6 - length(p.xz - vec2<f32>(0.0, 7.0));
        light = mix(frame.backdrop_low.xyz * 0.28, light, smoothstep(0.0, 1.9, from_hedge));
        light = fogged(light, distance);
    } else {
        // The hedge, and over it what is far.
        // Turned against the grid of the noise, so that it makes no rows.
        let h = vec2<f32>(0.8 * p.x + 0.6 * p.y, 0.8 * p.y - 0.6 * p.x);
        let leaves = patches(h * 10.0) * 0.4 + patches(h.yx * 3.7) * 0.6;
        let top = 1.02 + 0.12 * leaves;
        // The sun lies on its upper leaves.
        let sunny = smoothstep(-0.42, 0.06, p.y - top) * (0.3 + 0.7 * leaves);
        let tone = (0.50 + 0.5 * leaves) * mix(0.36, 1.15, smoothstep(0.0, 1.0, p.y));
        let hedge = frame.glow.xyz * (0.13 * sunny) + frame.backdrop_low.xyz * tone;
        let cover = smoothstep(-blur - 0.02, blur + 0.02, top - p.y);
        light = mix(fogged(trees(q, far_blur()), distance + 2.0), fogged(hedge, distance), cover);
    }
    return written(light, 1.0, v.clip.xy);
}

// A lamp far away.
fn spot(d: vec2<f32>, blur: f32) -> f32 {
    let size = 0.0012 + 0.30 * blur;
    return smoothstep(1.3 * size, 0.7 * size, length(d));
}

// Sky, stars, moon and hills, by direction.
fn night_sky(q: vec2<f32>, blur: f32) -> vec3<f32> {
    let low = frame.backdrop_low.xyz;
    var light = mix(low, frame.backdrop_high.xyz, smoothstep(-0.01, 0.17, q.y));
    let up = smoothstep(0.03, 0.10, q.y);
    // What the lens spreads is the fainter for it.
    let star = 0.0012 + 0.13 * blur;
    let spread = min(0.0028 / star, 1.0);
    let shine = discs(q, 0.047, star, star, 21) + 0.4 * discs(q + 0.013, 0.029, 0.6 * star, 0.6 * star, 22);
    light += frame.glow.xyz * (up * 0.65 * spread * shine);
    // The moon, a cloud's breadth of light about it.
    let m = q - vec2<f32>(0.066, 0.091);
    let d = length(m);
    let disc = smoothstep(0.0125 + 0.4 * blur, 0.0125 - 0.4 * blur, d);
    light += frame.glow.xyz * (0.16 * exp(-d * 22.0) + 0.10 * exp(-d * 60.0));
    let dimmed = mix(1.0, 0.35, smoothstep(0.012, 0.026, blur));
    light = mix(light, frame.glow.xyz * (2.1 - 0.5 * patches(m * 130.0 + 7.0)), disc * dimmed);
    // Two ridges, the nearer darker.
    let far = 0.030 + 0.034 * sin(q.x * 7.0 + 0.9) + 0.012 * sin(q.x * 19.0);
    let near = 0.004 + 0.022 * sin(q.x * 9.0 - 1.3) + 0.008 * sin(q.x * 31.0 + 1.0);
    light = mix(light, low * mix(0.50, 0.34, smoothstep(-0.02, 0.04, q.y)), smoothstep(-blur, blur, far - q.y));
    light = mix(light, low * mix(0.34, 0.17, smoothstep(-0.03, 0.02, q.y)), smoothstep(-blur, blur, near - q.y));
    // Windows of a village at the foot of the hills.
    let w = q - vec2<f32>(-0.205, 0.007);
    let lamps = 0.8 * spot(w, blur) + spot(w - vec2<f32>(0.026, 0.004), blur)
        + 0.6 * spot(w - vec2<f32>(0.043, -0.003), blur)
        + 0.7 * spot(w - vec2<f32>(0.385, 0.005), blur);
    return light + frame.glow.xyz * vec3<f32>(2.6, 1.05, 0.20) * (0.50 * min(0.005 / blur, 1.0) * lamps);
}

@fragment
fn fs_night(v: TheatreOut) -> @location(0) vec4<f32> {
    let level = max(length(v.ray.xz), 1e-4);
    let q = vec2<f32>(atan2(v.ray.x, -v.ray.z), v.ray.y / level);
    let t_floor = floor_time(v.ray);
    let distance = min(t_floor * length(v.ray), 60.0);
    let blur = far_blur();
    // Mist lies low: the moon comes through.
    let air = mix(16.0, 2.5, smoothstep(-0.02, 0.14, q.y));
    var light = fogged(night_sky(q, blur), air + length(frame.eye_in_world.xz));
    if t_floor < 1e8 {
        let p = frame.eye_in_world.xyz + v.ray * t_floor;
        let px = distance * frame.viewport.w * 1.2 + edge_blur(distance);
        let r = length(p.xz);
        let ground = frame.floor.xyz * (grass(p, px)) * (floor_light(p, v.clip.xy, 0.22) + frame.rim.xyz * 0.35);
        let near = mix(ground, frame.backdrop_low.xyz * 0.34, smoothstep(1.5, 20.0, r));
        light = mix(light, fogged(near, distance), smoothstep(-0.002, -0.004 - blur, q.y));
    }
    return written(light, 1.0, v.clip.xy);
}

// A pale wall over a dado, and a blackboard in its frame.
fn school_wall(u: f32, y: f32, blur: f32) -> vec3<f32> {
    let low = frame.backdrop_low.xyz;
    var light = mix(low * 0.60, frame.backdrop_high.xyz * 0.80, smoothstep(-blur, blur, y - 0.74));
    light = mix(light, frame.floor.xyz * 0.62, within(y - 0.74, 0.025, blur));
    light = mix(light, frame.floor.xyz * 0.40, smoothstep(blur, -blur, y - 0.09));
    // Daylight from the windows at the character's right, less of it under the ceiling.
    light *= mix(1.05, 0.62, smoothstep(-2.2, 2.6, u)) * mix(1.0, 0.72, smoothstep(2.0, 3.6, y));
    light *= mix(1.0, 0.70, smoothstep(1.0, 2.6, abs(u)));
    let q = vec2<f32>(u - 0.05, y - 1.66);
    let shade = within_box(q + vec2<f32>(-0.05, 0.06), vec2<f32>(1.56, 0.68), blur + 0.05);
    light *= 1.0 - 0.35 * shade;
    let wood = within_box(q, vec2<f32>(1.54, 0.66), blur);
    light = mix(light, frame.floor.xyz * (0.75 - 0.2 * q.y), wood);
    let board = within_box(q, vec2<f32>(1.48, 0.60), blur);
    // Chalk that was wiped away, and a few lines that were not.
    let dust = patches(q * vec2<f32>(1.6, 3.1) + 5.0) * 0.6 + patches(q * vec2<f32>(5.0, 3.0)) * 0.4;
    let row = fract(q.y / 0.17 + 0.2) - 0.5 + 0.035 * sin(q.x * 61.0) * sin(q.x * 23.0);
    let words = smoothstep(0.38, 0.62, patches(vec2<f32>(q.x * 8.5, floor(q.y / 0.17 + 0.2) * 7.0)));
    let place = within_box(q - vec2<f32>(0.92, 0.06), vec2<f32>(0.40, 0.33), 0.06)
        + within_box(q - vec2<f32>(-0.98, 0.14), vec2<f32>(0.34, 0.26), 0.06);
    let chalk = 0.16 * dust + 0.19 * place * words * within(row * 0.17, 0.016, blur);
    let slate = low * vec3<f32>(0.115, 0.205, 0.190);
    let written_on = slate * mix(1.15, 0.8, smoothstep(-1.5, 1.5, u)) + frame.backdrop_high.xyz * (0.30 * chalk);
    light = mix(light, written_on, board);
    let tray = within_box(q + vec2<f32>(0.0, 0.685), vec2<f32>(1.50, 0.028), blur);
    return mix(light, frame.floor.xyz * 0.62, tray);
}

// The teacher's desk at the character's left, two books and an apple on it; how much it covers
// is in w.
fn desk(ray: vec3<f32>) -> vec4<f32> {
    let eye = frame.eye_in_world.xyz;
    let wood = frame.floor.xyz;
    let t_front = (-1.45 - eye.z) / min(ray.z, -1e-4);
    let t_top = (0.74 - eye.y) / min(ray.y, -1e-4);
    if ray.z > -1e-4 || eye.z < -1.0 || eye.y < 0.76 {
        return vec4<f32>(0.0);
    }
    let blur = edge_blur(t_front * length(ray));
    let f = (eye + ray * t_front).xy - vec2<f32>(1.34, 0.37);
    let p = (eye + ray * t_top).xz - vec2<f32>(1.34, -1.75);
    // Its front: a panel between posts.
    let front = within_box(f, vec2<f32>(0.62, 0.37), blur);
    let inset = within_box(f - vec2<f32>(0.0, -0.03), vec2<f32>(0.52, 0.27), blur);
    var tone = wood * (0.52 - 0.14 * inset) * mix(0.55, 1.0, smoothstep(-0.37, 0.30, f.y));
    let top = select(0.0, within_box(p, vec2<f32>(0.66, 0.32), blur), ray.y < -1e-4);
    tone = mix(tone, wood * 1.25, max(top, within_box(f - vec2<f32>(0.0, 0.36), vec2<f32>(0.66, 0.02), blur)));
    // What lies there stands upright in the plane of the front.
    let b = f - vec2<f32>(-0.24, 0.43);
    let books = within_box(b, vec2<f32>(0.15, 0.055), blur);
    let cover = mix(vec3<f32>(0.30, 0.42, 0.62), vec3<f32>(0.62, 0.36, 0.26), smoothstep(-blur, blur, b.y));
    tone = mix(tone, wood * cover, books);
    let d = f - vec2<f32>(0.20, 0.42);
    let apple = smoothstep(blur, -blur, length(d) - 0.045);
    tone = mix(tone, wood * vec3<f32>(1.9, 0.42, 0.28) * (0.8 + 6.0 * d.y), apple);
    return vec4<f32>(tone, max(max(front, top), max(books, apple)));
}

@fragment
fn fs_school(v: TheatreOut) -> @location(0) vec4<f32> {
    let eye = frame.eye_in_world.xyz;
    let wall = room_wall(v.ray, -2.8, 3.5);
    let t_floor = floor_time(v.ray);
    let distance = min(t_floor, wall.w) * length(v.ray);
    var light: vec3<f32>;
    if t_floor < wall.w {
        let p = eye + v.ray * t_floor;
        let plank = planks(p, distance * frame.viewport.w * 1.2 + edge_blur(distance));
        light = frame.floor.xyz * (plank.x * 0.8) * floor_light(p, v.clip.xy, 0.55);
        light *= mix(1.0, 0.7, smoothstep(1.8, 2.8, -p.z));
        light *= 1.0 - 0.55 * within_box(p.xz - vec2<f32>(1.34, -1.70), vec2<f32>(0.72, 0.40), 0.16);
    } else {
        light = school_wall(wall.x, wall.y, edge_blur(distance));
    }
    let before = desk(v.ray);
    light = mix(light, before.xyz, before.w);
    return written(fogged(light, distance), 1.0, v.clip.xy);
}
