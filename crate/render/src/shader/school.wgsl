// Set "school": a classroom with a window, a blackboard and the teacher's desk.

// Centres of the blackboard and of the window on the wall, metres.
const BOARD_X = 0.62;
const BOARD_Y = 1.56;
const WINDOW_X = -1.28;

// Chalk on the board: A B C, a house under a sun, a triangle; 0..1.
fn on_board(q: vec2<f32>, blur: f32) -> f32 {
    var lines = array<vec4<f32>, 20>(
        // A B C: start and end points.
        vec4<f32>(-0.02, 0.18, 0.06, 0.40), vec4<f32>(0.06, 0.40, 0.14, 0.18), vec4<f32>(0.01, 0.26, 0.11, 0.26),
        vec4<f32>(0.24, 0.18, 0.24, 0.40), vec4<f32>(0.24, 0.40, 0.35, 0.36), vec4<f32>(0.35, 0.36, 0.25, 0.30),
        vec4<f32>(0.25, 0.30, 0.38, 0.25), vec4<f32>(0.38, 0.25, 0.24, 0.18), vec4<f32>(0.63, 0.37, 0.55, 0.40),
        vec4<f32>(0.55, 0.40, 0.49, 0.29), vec4<f32>(0.49, 0.29, 0.54, 0.18), vec4<f32>(0.54, 0.18, 0.64, 0.22),
        // A house.
        vec4<f32>(0.20, -0.42, 0.20, -0.18), vec4<f32>(0.20, -0.18, 0.52, -0.18), vec4<f32>(0.52, -0.18, 0.52, -0.42),
        vec4<f32>(0.52, -0.42, 0.20, -0.42), vec4<f32>(0.16, -0.18, 0.36, 0.00), vec4<f32>(0.36, 0.00, 0.56, -0.18),
        vec4<f32>(0.32, -0.42, 0.32, -0.28), vec4<f32>(0.32, -0.28, 0.41, -0.28),
    );
    var nearest = 9.0;
    for (var i = 0; i < 20; i++) {
        nearest = min(nearest, from_piece(q, lines[i].xy, lines[i].zw));
    }
    // The sun above the house.
    let s = q - vec2<f32>(0.74, -0.06);
    let around = atan2(s.y, s.x);
    let ray = abs(fract(around * 1.5915 + 0.5) - 0.5) * length(s) * 0.6283;
    let spoke = select(9.0, ray, length(s) > 0.085 && length(s) < 0.13);
    nearest = min(nearest, min(abs(length(s) - 0.06), spoke));
    let grain = 0.65 + 0.35 * patches(q * 60.0);
    return drawn(nearest, 0.007, blur) * grain;
}

// A tall window: daylight over trees, bars, a white frame.
fn window(w: vec2<f32>, blur: f32) -> vec3<f32> {
    let sky = frame.backdrop_high.xyz * vec3<f32>(3.1, 3.4, 3.8);
    let crown = 0.02 + 0.20 * patches(vec2<f32>(w.x * 5.0 + 3.0, 0.5)) + 0.06 * patches(w * 9.0);
    let tree = frame.backdrop_high.xyz * vec3<f32>(1.05, 1.55, 0.85) * (0.7 + 0.5 * patches(w * 6.0 + 2.0));
    let outside = mix(sky, tree, smoothstep(0.03 + blur, -0.03 - blur, w.y - crown + 0.10));
    let bars = max(within(w.x, 0.022, blur), max(within(w.y - 0.28, 0.018, blur), within(w.y + 0.28, 0.018, blur)));
    let rim = 1.0 - within_box(w, vec2<f32>(0.455, 0.755), blur);
    return mix(outside, frame.backdrop_high.xyz * 1.35, saturate1(max(bars, rim)));
}

// A pale wall over a dado, and a blackboard in its frame.
fn school_wall(u: f32, y: f32, blur: f32) -> vec3<f32> {
    let low = frame.backdrop_low.xyz;
    var light = mix(low * 0.60, frame.backdrop_high.xyz * 0.80, smoothstep(-blur, blur, y - 0.74));
    light = mix(light, frame.floor.xyz * 0.62, within(y - 0.74, 0.025, blur));
    light = mix(light, frame.floor.xyz * 0.40, smoothstep(blur, -blur, y - 0.09));
    // Daylight from the windows at the character's right, weaker under the ceiling.
    light *= mix(1.12, 0.60, smoothstep(-1.0, 2.2, u)) * mix(1.0, 0.72, smoothstep(2.0, 3.6, y));
    light *= mix(1.0, 0.70, smoothstep(1.0, 2.6, abs(u)));
    let q = vec2<f32>(u - BOARD_X, y - BOARD_Y);
    let shade = within_box(q + vec2<f32>(-0.04, 0.05), vec2<f32>(1.24, 0.64), blur + 0.04);
    light *= 1.0 - 0.35 * shade;
    let wood = within_box(q, vec2<f32>(1.22, 0.62), blur);
    light = mix(light, frame.floor.xyz * (0.75 - 0.2 * q.y), wood);
    let board = within_box(q, vec2<f32>(1.16, 0.56), blur);
    // Wiped chalk, with newer writing over it.
    let dust = patches(q * vec2<f32>(1.6, 3.1) + 5.0) * 0.6 + patches(q * vec2<f32>(5.0, 3.0)) * 0.4;
    var chalk = 0.13 * dust;
    if board > 0.0 {
        chalk += 0.62 * on_board((q + vec2<f32>(0.20, 0.0)) / 0.86, blur);
    }
    let slate = low * vec3<f32>(0.115, 0.205, 0.190);
    let written_on = slate * mix(1.25, 0.8, smoothstep(-1.2, 1.2, q.x)) + frame.backdrop_high.xyz * chalk;
    light = mix(light, written_on, board);
    light = mix(light, window(vec2<f32>(u - WINDOW_X, y - 1.62), blur), within_box(vec2<f32>(u - WINDOW_X, y - 1.62), vec2<f32>(0.50, 0.80), blur));
    let tray = within_box(q + vec2<f32>(0.0, 0.645), vec2<f32>(1.18, 0.028), blur);
    return mix(light, frame.floor.xyz * 0.62, tray);
}

// The teacher's desk at the character's left with two books and an apple; w is the coverage.
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
    // Front of the desk: a panel between posts.
    let front = within_box(f, vec2<f32>(0.62, 0.37), blur);
    let inset = within_box(f - vec2<f32>(0.0, -0.03), vec2<f32>(0.52, 0.27), blur);
    var tone = wood * (0.52 - 0.14 * inset) * mix(0.55, 1.0, smoothstep(-0.37, 0.30, f.y));
    let top = select(0.0, within_box(p, vec2<f32>(0.66, 0.32), blur), ray.y < -1e-4);
    tone = mix(tone, wood * 1.25, max(top, within_box(f - vec2<f32>(0.0, 0.36), vec2<f32>(0.66, 0.02), blur)));
    // Objects on the desk, upright in the plane of the front: books, an apple on them, a globe.
    let b = f - vec2<f32>(-0.10, 0.43);
    let books = within_box(b, vec2<f32>(0.15, 0.055), blur);
    let cover = mix(vec3<f32>(0.30, 0.42, 0.62), vec3<f32>(0.62, 0.36, 0.26), smoothstep(-blur, blur, b.y));
    tone = mix(tone, wood * cover, books);
    let d = f - vec2<f32>(-0.12, 0.530);
    let apple = smoothstep(blur, -blur, length(d) - 0.045);
    tone = mix(tone, wood * vec3<f32>(1.9, 0.42, 0.28) * (0.8 + 6.0 * d.y), apple);
    let g = f - vec2<f32>(-0.52, 0.600);
    let r = length(g) / 0.150;
    let depth = sqrt(max(1.0 - r * r, 0.0));
    let on = vec2<f32>(asin(clamp(g.x / 0.155, -1.0, 1.0)), g.y / 0.150);
    let land = smoothstep(0.50, 0.60, patches(on * vec2<f32>(1.9, 2.4) + vec2<f32>(11.0, 3.0)));
    let sea = frame.backdrop_high.xyz * mix(vec3<f32>(0.16, 0.42, 0.72), vec3<f32>(0.62, 0.58, 0.30), land);
    let ball = smoothstep(1.0 + blur / 0.15, 1.0 - blur / 0.15, r);
    let lit = 0.30 + 0.95 * saturate1(dot(vec3<f32>(g / 0.150, depth), vec3<f32>(-0.66, 0.42, 0.62)));
    let bow = drawn(abs(length(g) - 0.170), 0.007, blur) * step(-0.02, -g.x + 0.4 * g.y + 0.08);
    let stand = max(within_box(f - vec2<f32>(-0.52, 0.39), vec2<f32>(0.075, 0.018), blur), within_box(f - vec2<f32>(-0.52, 0.425), vec2<f32>(0.014, 0.03), blur));
    tone = mix(tone, wood * 0.7, max(bow, stand));
    tone = mix(tone, sea * lit, ball);
    let globe = max(ball, max(bow, stand));
    return vec4<f32>(tone, max(max(front, top), max(max(books, apple), globe)));
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
