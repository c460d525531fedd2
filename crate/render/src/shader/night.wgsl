// Set "night": a meadow with hills, stars and the moon; a lantern hangs near the speaker.

// Position of the lantern, metres.
const LANTERN = vec3<f32>(-0.62, 1.36, -0.9);
const LANTERN_COLOR = vec3<f32>(4.2, 2.3, 0.75);

// A distant lamp.
fn spot(d: vec2<f32>, blur: f32) -> f32 {
    let size = 0.0012 + 0.30 * blur;
    return smoothstep(1.3 * size, 0.7 * size, length(d));
}

// Sky, stars, moon and hills, by direction.
fn night_sky(q: vec2<f32>, blur: f32) -> vec3<f32> {
    let low = frame.backdrop_low.xyz;
    var light = mix(low, frame.backdrop_high.xyz, smoothstep(-0.01, 0.17, q.y));
    let up = smoothstep(0.03, 0.10, q.y);
    // The lens spreads the light of a star, which dims it accordingly.
    let star = 0.0012 + 0.13 * blur;
    let spread = min(0.0028 / star, 1.0);
    let shine = discs(q, 0.047, star, star, 21) + 0.4 * discs(q + 0.013, 0.029, 0.6 * star, 0.6 * star, 22);
    light += frame.glow.xyz * (up * 0.65 * spread * shine);
    // The moon, with a halo as wide as a cloud.
    let m = q - vec2<f32>(0.118, 0.098);
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
    // Lit windows of a village at the foot of the hills.
    let w = q - vec2<f32>(-0.205, 0.007);
    let lamps = 0.8 * spot(w, blur) + spot(w - vec2<f32>(0.026, 0.004), blur)
        + 0.6 * spot(w - vec2<f32>(0.043, -0.003), blur)
        + 0.7 * spot(w - vec2<f32>(0.385, 0.005), blur);
    return light + frame.glow.xyz * vec3<f32>(2.6, 1.05, 0.20) * (0.50 * min(0.005 / blur, 1.0) * lamps);
}

// A lantern on a bough at the left, and the light around it: colour in xyz, coverage in w; the
// second value is the added glow.
fn lantern(ray: vec3<f32>) -> array<vec4<f32>, 2> {
    let at = upright(ray, LANTERN.z);
    if at.z < 0.0 {
        return array<vec4<f32>, 2>(vec4<f32>(0.0), vec4<f32>(0.0));
    }
    let blur = edge_blur(at.z * length(ray));
    let dark = frame.backdrop_low.xyz;
    let flame = frame.glow.xyz * LANTERN_COLOR;
    let l = at.xy - LANTERN.xy;
    let r2 = dot(l, l);
    // Bough and leaves in front of the sky, lit from the lantern's side.
    let bend = 1.72 + 0.10 * sin(at.x * 2.6 + 0.6) - 0.05 * at.x;
    let bough = drawn(abs(at.y - bend), 0.020 + 0.018 * saturate1(-at.x - 0.2), blur) * smoothstep(-0.20, -0.45, at.x);
    let trunk = within(at.x + 1.16 + 0.04 * sin(at.y * 2.0), 0.115, blur);
    let there = 0.9 * smoothstep(0.34, 0.0, abs(at.y - bend - 0.13)) * smoothstep(-0.05, -0.5, at.x);
    let leaf = foliage(at.xy, there, blur);
    let lit = flame * (0.030 / (0.10 + 3.0 * r2));
    var seen = vec4<f32>(0.0);
    seen = mix(seen, vec4<f32>(dark * 0.22 + lit * vec3<f32>(0.5, 0.42, 0.35), 1.0), max(bough, trunk));
    seen = mix(seen, vec4<f32>(dark * (0.14 + 0.10 * leaf.x) + lit * vec3<f32>(0.16, 0.21, 0.10) * leaf.x, 1.0), leaf.z);
    // Chain, cap, four rods, foot.
    let chain = within(l.x, 0.010, blur) * step(0.10, l.y) * step(at.y, bend) * min(1.0, 0.7 + 0.007 / blur);
    let cap = within(l.x, 0.085 - 0.55 * (l.y - 0.085), blur) * within(l.y - 0.125, 0.042, blur);
    let foot = within_box(l + vec2<f32>(0.0, 0.105), vec2<f32>(0.074, 0.018), blur);
    let rods = max(within(abs(l.x) - 0.062, 0.006, blur), within(l.x, 0.004, blur) * 0.5) * within(l.y, 0.095, blur);
    let glass = within_box(l, vec2<f32>(0.060, 0.092), blur);
    let f = vec2<f32>(l.x / 0.022, (l.y + 0.015) / 0.046);
    let burning = exp(-dot(f, f));
    seen = mix(seen, vec4<f32>(flame * (0.30 + 0.30 * exp(-r2 * 260.0) + 1.8 * burning), 1.0), glass);
    seen = mix(seen, vec4<f32>(dark * 0.20 + lit * 0.12, 1.0), max(max(chain, cap), max(foot, rods)));
    let flicker = 1.0 + 0.06 * (patches(vec2<f32>(set_time() * 1.6, 0.5)) - 0.5);
    let halo = flame * (flicker * (0.20 * exp(-r2 * 30.0) + 0.055 * exp(-r2 * 4.0)));
    return array<vec4<f32>, 2>(seen, vec4<f32>(halo, 0.0));
}

// A fence with tall grass at its foot, lit by the lantern on this side and by the moon from behind;
// w is the coverage.
fn fence(ray: vec3<f32>) -> vec4<f32> {
    let at = upright(ray, -3.3);
    if at.z < 0.0 {
        return vec4<f32>(0.0);
    }
    let p = at.xy;
    let blur = edge_blur(at.z * length(ray));
    let d = vec3<f32>(p, -3.3) - LANTERN;
    let lit = frame.glow.xyz * LANTERN_COLOR * (2.6 / (1.0 + 0.42 * dot(d, d)));
    let post = (fract(p.x / 1.30 + 0.35) - 0.5) * 1.30;
    let stake = within(post, 0.050, blur) * smoothstep(blur, -blur, p.y - 1.06);
    let sag = 0.02 * sin(p.x * 2.1);
    let rails = max(within(p.y - 0.90 - sag, 0.036, blur), within(p.y - 0.56 + sag, 0.036, blur));
    let grain = 0.75 + 0.5 * patches(vec2<f32>(p.x * 5.0, p.y * 70.0));
    // The moon lights the upper edges.
    let edge = max(within(p.y - 0.93 - sag, 0.010, blur) * rails, 0.7 * within(post - 0.045, 0.010, blur) * stake);
    let wood = vec3<f32>(0.105, 0.078, 0.055) * grain * (lit + frame.sky.xyz * 0.5) + frame.rim.xyz * (0.085 * saturate1(edge));
    var seen = vec4<f32>(wood, max(stake, rails));
    let top = 0.20 + 0.26 * patches(vec2<f32>(p.x * 3.1, 1.5)) + 0.13 * patches(vec2<f32>(p.x * 17.0, 4.5));
    let blades = 0.55 + 0.9 * patches(vec2<f32>(p.x * 34.0, p.y * 5.0));
    let green = vec3<f32>(0.040, 0.060, 0.024) * blades * (lit + frame.sky.xyz) + frame.rim.xyz * (0.050 * smoothstep(0.10, 0.0, top - p.y));
    return mix(seen, vec4<f32>(green, 1.0), smoothstep(-blur - 0.03, blur + 0.03, top - p.y));
}

@fragment
fn fs_night(v: TheatreOut) -> @location(0) vec4<f32> {
    let level = max(length(v.ray.xz), 1e-4);
    let q = vec2<f32>(atan2(v.ray.x, -v.ray.z), v.ray.y / level);
    let t_floor = floor_time(v.ray);
    let distance = min(t_floor * length(v.ray), 60.0);
    let blur = far_blur();
    // Mist is low, so the moon shines through.
    let air = mix(16.0, 2.5, smoothstep(-0.02, 0.14, q.y));
    var light = fogged(night_sky(q, blur), air + length(frame.eye_in_world.xz));
    if t_floor < 1e8 {
        let p = frame.eye_in_world.xyz + v.ray * t_floor;
        let px = distance * frame.viewport.w * 1.2 + edge_blur(distance);
        let r = length(p.xz);
        let ground = frame.floor.xyz * (grass(p, px)) * (floor_light(p, v.clip.xy, 0.22) + frame.rim.xyz * 0.35);
        let meadow = mix(ground, frame.backdrop_low.xyz * 0.34, smoothstep(1.5, 20.0, r));
        // Light of the lantern on the grass.
        let d = p.xz - LANTERN.xz;
        let lit = frame.floor.xyz * frame.glow.xyz * vec3<f32>(4.2, 2.6, 0.9) * (0.9 * grass(p, px) / (1.0 + 1.6 * dot(d, d)));
        light = mix(light, fogged(meadow + lit, distance), smoothstep(-0.002, -0.004 - blur, q.y));
    }
    let near = fence(v.ray);
    light = mix(light, fogged(near.xyz, 4.0), near.w);
    let lamp = lantern(v.ray);
    light = mix(light, lamp[0].xyz, lamp[0].w) + lamp[1].xyz;
    return written(light, 1.0, v.clip.xy);
}

