// Set "fireside": a stone chimney with its hearth, a mantelpiece, bookshelves.

const HEARTH_X = -1.04;
// Boundary between the chimney and the shelves, metres.
const CHIMNEY_X = -0.30;
const SHELVES_X = 0.34;
// Height of the hearth's floor, metres.
const HEARTH_Y = 0.64;

// Stones in courses of uneven height, each with its own tone and curved face: the tone in x; y is 0
// in the joints.
fn masonry(p: vec2<f32>, blur: f32) -> vec2<f32> {
    let bent = p + vec2<f32>(0.012 * sin(p.y * 19.0 + 2.3 * sin(p.x * 5.0)), 0.007 * sin(p.x * 11.0 + 2.0) + 0.004 * sin(p.x * 27.0));
    let row = floor(bent.y / 0.165);
    let shift = hash_unit(vec3<i32>(i32(row), 3, 7));
    let wide = 0.24 + 0.14 * hash_unit(vec3<i32>(i32(row), 9, 7));
    let x = bent.x / wide + shift * 3.0;
    let cell = floor(x);
    let tint = hash_unit(vec3<i32>(i32(cell), i32(row), 11));
    let f = vec2<f32>(x - cell, bent.y / 0.165 - row);
    let d = min(min(f.x, 1.0 - f.x) * wide, min(f.y, 1.0 - f.y) * 0.165);
    let joint = smoothstep(0.0, 0.009 + 1.3 * blur, d + 0.55 * blur);
    // Lit from below: the lower half of each stone curves towards the fire.
    let face = mix(1.07, 0.95, f.y);
    let rough = patches(vec2<f32>(0.8 * p.x + 0.6 * p.y, 0.8 * p.y - 0.6 * p.x) * 17.0);
    // Out of focus, the finest detail is unresolved.
    let sharp = saturate1(1.4 - 28.0 * blur);
    let chipped = patches(vec2<f32>(0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y) * 41.0);
    return vec2<f32>((0.72 + 0.42 * tint + 0.40 * (rough - 0.5) + 0.24 * sharp * (chipped - 0.5)) * face, joint);
}

// Flames over logs and their glow, relative to the centre of the hearth's floor.
fn fire(x: f32, y: f32, blur: f32) -> vec3<f32> {
    let t = set_time();
    // Flames sway and rise; they are steadier at the bottom.
    let rise = patches(vec2<f32>(x * 8.0 + 4.0, y * 6.5 - t * 1.9));
    let sway = patches(vec2<f32>(x * 3.0 - 9.0, y * 3.0 - t * 1.1)) - 0.5;
    let q = x + 0.22 * sway * saturate1(2.5 * y);
    // Flames of uneven height within one envelope, with others behind them.
    let front = patches(vec2<f32>(q * 15.0 + 7.0, y * 2.2 - t * 1.0));
    let behind = patches(vec2<f32>(q * 22.0 - 3.0, y * 2.6 - t * 1.3));
    let hood = exp(-q * q * 14.0);
    let tall = hood * (0.05 + 0.42 * front * (0.35 + behind));
    let flame = tall - y + 0.12 * (rise - 0.5) * saturate1(4.0 * y);
    let edge = 0.060 + 3.0 * blur;
    let heat = smoothstep(-edge, edge, flame) * smoothstep(-0.03, 0.03, y);
    let core = smoothstep(-0.01, 0.17, flame);
    let g = vec2<f32>(x / 0.42, (y - 0.02) / 0.40);
    var light = frame.glow.xyz * (0.85 * exp(-dot(g, g)));
    light += heat * frame.glow.xyz * mix(vec3<f32>(2.4, 1.9, 1.0), vec3<f32>(4.6, 9.0, 10.5), core);
    // Two stacked logs with embers between them.
    let low = drawn(from_piece(vec2<f32>(x, y), vec2<f32>(-0.27, 0.035), vec2<f32>(0.24, 0.045)), 0.040, blur);
    let high = drawn(from_piece(vec2<f32>(x, y), vec2<f32>(-0.17, 0.125), vec2<f32>(0.25, 0.075)), 0.034, blur);
    let glowing = 0.35 + 1.2 * patches(vec2<f32>(x * 26.0, y * 30.0 - t * 0.15));
    let ember = exp(-abs(y - 0.082) * 42.0) * glowing;
    light = mix(light, frame.glow.xyz * (0.16 + 0.9 * ember), max(low, high) * 0.92);
    let bed = exp(-x * x * 9.0) * smoothstep(0.03, -0.01, y);
    return light + frame.glow.xyz * vec3<f32>(2.2, 2.0, 1.0) * (bed * glowing);
}

// Objects on the mantelpiece: a clock, books that lean on a jug, a candle; w is the coverage.
fn on_mantel(x: f32, y: f32, blur: f32) -> vec4<f32> {
    let wood = frame.floor.xyz;
    var tone = vec4<f32>(0.0);
    // Clock in a round case on a foot.
    let c = vec2<f32>(x + 0.10, y - 0.165);
    let r = length(c);
    let foot = within_box(c + vec2<f32>(0.0, 0.135), vec2<f32>(0.085, 0.028), blur);
    let round = smoothstep(blur, -blur, r - 0.130);
    tone = mix(tone, vec4<f32>(wood * 0.75, 1.0), max(round, foot));
    let dial = smoothstep(blur, -blur, r - 0.098);
    let hands = max(drawn(from_piece(c, vec2<f32>(0.0), vec2<f32>(0.0, 0.072)), 0.006, blur),
        drawn(from_piece(c, vec2<f32>(0.0), vec2<f32>(0.046, 0.024)), 0.007, blur));
    tone = mix(tone, vec4<f32>(mix(vec3<f32>(0.150, 0.120, 0.080), vec3<f32>(0.012), hands), 1.0), dial);
    // Jug of glazed clay.
    let j = vec2<f32>(x - 0.30, y);
    let belly = 0.060 + 0.022 * sin(saturate1(j.y / 0.21) * 3.6 - 0.3);
    let jug = within(j.x, belly, blur) * within(j.y - 0.10, 0.105, blur);
    tone = mix(tone, vec4<f32>(vec3<f32>(0.035, 0.060, 0.075) * (0.7 + 9.0 * max(-j.x, 0.0)), 1.0), jug);
    // The candle is at the far end.
    let k = vec2<f32>(x + 0.47, y);
    let stick = max(within_box(k - vec2<f32>(0.0, 0.012), vec2<f32>(0.050, 0.012), blur), within_box(k - vec2<f32>(0.0, 0.12), vec2<f32>(0.016, 0.105), blur));
    tone = mix(tone, vec4<f32>(vec3<f32>(0.210, 0.165, 0.105) * (0.35 + 4.0 * max(k.y, 0.0)), 1.0), stick);
    return tone;
}

// Rows of books between boards and uprights.
fn bookshelf(u: f32, y: f32, blur: f32) -> vec3<f32> {
    let wood = frame.floor.xyz;
    let shelf = floor((y - 0.20) / 0.36);
    let h = y - 0.20 - shelf * 0.36;
    let seed = i32(shelf) * 31;
    let x = u / 0.062 + 0.42 * sin(u * 23.0 + shelf * 2.0);
    let cell = floor(x);
    let one = hash_unit(vec3<i32>(i32(cell), seed, 3));
    let two = hash_unit(vec3<i32>(i32(cell), seed, 4));
    let f = x - cell;
    let b = blur / 0.062;
    // Occasional gaps next to leaning books.
    let there = step(0.09, two);
    let book = smoothstep(0.0, 0.10 + b, min(f, 1.0 - f)) * smoothstep(blur, -blur, h - (0.20 + 0.09 * one)) * there;
    // Leather and cloth: mostly brown, some wine, green and blue.
    let dye = mix(vec3<f32>(1.00, 0.66, 0.42), vec3<f32>(0.95, 0.30, 0.26), step(0.45, two));
    let cool = mix(dye, mix(vec3<f32>(0.36, 0.60, 0.42), vec3<f32>(0.30, 0.44, 0.72), step(0.86, two)), step(0.68, two));
    let band = within(h - 0.13, 0.012, blur) + within(h - 0.06, 0.006, blur);
    let round = 0.55 + 1.7 * f * (1.0 - f);
    let spine = wood * cool * (round * (0.8 + 1.0 * one)) + vec3<f32>(0.10, 0.07, 0.03) * (0.35 * band * step(0.4, one));
    let dark = wood * 0.10;
    var light = mix(dark, spine, book);
    // Boards, each with a shadow below it.
    light *= mix(0.45, 1.0, smoothstep(0.34, 0.20, h));
    let board = max(within(h, 0.016, blur), within(h - 0.36, 0.016, blur));
    light = mix(light, wood * 0.95, board);
    let upright = within(abs(u - 1.10) - 0.75, 0.022, blur) + within(u - 1.10, 0.016, blur);
    return mix(light, wood * 0.80, saturate1(upright));
}

// Wooden panels below a plain wall.
fn plaster(u: f32, y: f32, blur: f32) -> vec3<f32> {
    let wood = frame.floor.xyz;
    let mottled = 0.92 + 0.16 * patches(vec2<f32>(u * 3.1, y * 2.3));
    let wall = frame.backdrop_low.xyz * 1.5 * mottled;
    let panel = abs(fract(u / 0.27 + 0.35) - 0.5) * 0.27;
    let below = wood * (0.42 + 0.16 * smoothstep(0.095 + blur, 0.095 - blur, panel));
    let rail = within(y - 1.02, 0.030, blur);
    return mix(mix(below, wall, smoothstep(-blur, blur, y - 1.02)), wood * 0.8, rail);
}

// The wall: shelves at the right, the chimney at the left.
fn hearth_wall(u: f32, y: f32, blur: f32) -> vec3<f32> {
    let low = frame.backdrop_low.xyz;
    let wood = frame.floor.xyz;
    let x = u - HEARTH_X;
    let q = vec2<f32>(x * 0.52, (y - HEARTH_Y - 0.25) * 0.66);
    let warm = exp(-dot(q, q));
    let flicker = 1.0 + 0.10 * (patches(vec2<f32>(set_time() * 1.7, 0.5)) - 0.5);
    let lit = frame.glow.xyz * (warm * flicker);
    let candle = vec2<f32>(x + 0.47, y - 1.80);
    let halo = exp(-dot(candle, candle) * 16.0);
    // The wall and the shelves are lit from the side of the fire only.
    let from_fire = 0.26 + 1.05 * exp(-0.9 * (u + 0.4)) * vec3<f32>(1.0, 0.86, 0.70) + 0.30 * halo;
    let shelves = smoothstep(SHELVES_X - blur, SHELVES_X + blur, u);
    var beyond = vec3<f32>(0.0);
    if shelves > 0.0 {
        beyond = bookshelf(u, y, blur) * from_fire;
    }
    let chimney = smoothstep(CHIMNEY_X + blur, CHIMNEY_X - blur, u);
    var wall = vec3<f32>(0.0);
    if chimney < 1.0 {
        wall = mix(plaster(u, y, blur) * from_fire, beyond, shelves) * smoothstep(CHIMNEY_X - 0.04, CHIMNEY_X + 0.10 + blur, u);
    }
    if chimney <= 0.0 {
        return wall;
    }
    let stone = masonry(vec2<f32>(u, y), blur);
    let tone = (low * 1.7 + lit * 0.34 + frame.glow.xyz * (0.16 * halo)) * stone.x;
    var light = mix(low * 0.95 + lit * 0.14, tone, stone.y);
    // An arch of long stones around the opening, black with soot inside.
    let arch = 1.22 - 0.55 * x * x;
    let side = within(x, 0.43, blur) * step(HEARTH_Y, y);
    let rim = side * smoothstep(arch + 0.13 + blur, arch + 0.13 - blur, y);
    let wedge = abs(fract(x * 8.5 + 0.5) - 0.5);
    light = mix(light, (low * 2.0 + lit * 0.42) * (0.75 + 0.35 * smoothstep(0.02, 0.08 + 4.0 * blur, wedge)), rim * step(arch - 0.3, y));
    let open = within(x, 0.385, blur) * smoothstep(arch + blur, arch - blur, y) * smoothstep(HEARTH_Y - blur, HEARTH_Y + blur, y);
    if open > 0.0 {
        let back = low * 0.10 + frame.glow.xyz * (0.20 * exp(-6.0 * (y - HEARTH_Y)));
        light = mix(light, back + fire(x, y - HEARTH_Y, blur), open);
    }
    let slab = within_box(vec2<f32>(x, y - HEARTH_Y + 0.05), vec2<f32>(0.62, 0.05), blur);
    light = mix(light, (low * 2.2 + lit * 0.55) * (0.8 + 0.3 * stone.x), slab);
    // The beam above, lit from below, and its shadow on the stones over it.
    let beam = within_box(vec2<f32>(x, y - 1.48), vec2<f32>(0.74, 0.062), blur);
    light *= 1.0 - 0.40 * within(x, 0.76, 2.0 * blur) * smoothstep(0.22, 0.0, y - 1.54) * step(1.48, y);
    let grain = 0.85 + 0.3 * patches(vec2<f32>(x * 4.0, y * 60.0));
    light = mix(light, (wood * 0.55 + frame.glow.xyz * (0.22 * exp(-3.0 * x * x) * smoothstep(1.54, 1.42, y))) * grain, beam);
    let thing = on_mantel(x, y - 1.542, blur);
    light = mix(light, thing.xyz * (0.8 + 0.5 * halo), thing.w);
    // The candle flame, whiter because it is small.
    let f = vec2<f32>(x + 0.47, (y - 1.80) * 0.55);
    let flame = smoothstep(0.020 + blur, 0.004, length(f)) * min(1.0, 0.45 + 0.008 / blur);
    return mix(wall, light + frame.glow.xyz * vec3<f32>(4.0, 7.0, 7.0) * flame, chimney);
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
    // Light of the fire on the floor in front of the hearth.
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

