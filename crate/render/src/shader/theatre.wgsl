// Set "theatre": a board floor in a pool of light, and a curtain in a wide curve behind the
// speaker. Ray-cast per pixel, without triangles.

const CURTAIN_RADIUS = 3.1;

struct TheatreOut {
    @builtin(position) clip: vec4<f32>,
    @location(0) ray: vec3<f32>,
};

@vertex
fn vs_theatre(@builtin(vertex_index) i: u32) -> TheatreOut {
    // One triangle over the whole image, at the far plane.
    let q = vec2<f32>(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0);
    var o: TheatreOut;
    o.clip = vec4<f32>(q, 1.0, 1.0);
    o.ray = frame.ray_forward.xyz + (frame.ray_right.xyz * q.x + frame.ray_up.xyz * q.y) * (1.0 + frame.still[0].w);
    return o;
}

// Curvature of the curtain: depth of the fold in z (0..1) and slope along the arc in x.
fn folds(arc: f32, height: f32) -> vec2<f32> {
    // Folds vary with height, and each fold is different.
    let sway = 0.30 * sin(arc * 1.7 + 0.8 + 0.35 * height) + 0.16 * sin(arc * 4.1 - 0.5 * height + 2.0);
    let phase = arc * 15.0 + sway * 2.6;
    // Hanging cloth is round in front and narrow behind. The lens, focused on the speaker, softens
    // the folds.
    let s = sin(phase);
    return vec2<f32>(0.75 * cos(phase) * (1.0 - 0.45 * s), 0.56 + 0.36 * s - 0.12 * s * s);
}

// The valance above: swags with a gold fringe; w is the coverage.
fn valance(arc: f32, y: f32, tone: vec3<f32>, light: vec3<f32>) -> vec4<f32> {
    let blur = 0.014;
    let swag = fract(arc / 1.16 + 0.5) - 0.5;
    let edge = 2.03 + 0.62 * swag * swag;
    // Folds run from both upper corners to the centre.
    let fall = (2.75 - y) / max(2.75 - edge, 0.1);
    let fold = sin(24.0 * fall + 9.0 * swag * swag);
    let cloth = (tone * 1.35 + light * 0.30) * (0.85 + 0.35 * fold) * mix(1.0, 0.55, smoothstep(0.36, 0.5, abs(swag)));
    let gold = light * vec3<f32>(1.5, 1.9, 1.1) + vec3<f32>(0.030, 0.019, 0.006);
    let threads = 0.75 + 0.35 * sin(arc * 190.0);
    let d = y - edge;
    let fringe = smoothstep(-0.075 - blur, -0.075 + blur, d) * smoothstep(0.012, -0.012, d);
    let braid = smoothstep(-0.014 - blur, 0.014 - blur, d) * smoothstep(0.040 + blur, 0.040 - blur, d);
    let shown = mix(cloth, gold * mix(threads, 1.3, braid), max(fringe, braid));
    return vec4<f32>(shown, smoothstep(-0.075 - blur, -0.075 + blur, d));
}

fn curtain(p: vec3<f32>, ray: vec3<f32>) -> vec3<f32> {
    let angle = atan2(p.x, -p.z);
    let arc = angle * CURTAIN_RADIUS;
    let fold = folds(arc, p.y);
    let inwards = normalize(vec3<f32>(-p.x, 0.0, -p.z));
    let aside = vec3<f32>(cos(angle), 0.0, sin(angle));
    let n = normalize(inwards - aside * (fold.x * 0.42));
    let high = smoothstep(0.2, 3.4, p.y);
    let tone = mix(frame.backdrop_low.xyz, frame.backdrop_high.xyz, high);
    // Pool of light behind the speaker: wide, low, and softer upwards.
    let q = vec2<f32>(arc * 0.72, (p.y - 1.30) * 0.72);
    let pool = exp(-dot(q, q) * 1.35);
    let cavity = mix(0.45, 1.10, smoothstep(0.0, 1.0, fold.y));
    let from_key = saturate1(0.45 + 0.55 * dot(n, normalize(frame.key_dir.xyz * vec3<f32>(1.0, 0.4, 1.0))));
    // Velvet brightens where the pile is seen from the side.
    let pile = 1.0 - abs(dot(n, normalize(ray)));
    var light = tone * (0.55 + 0.75 * from_key) + frame.glow.xyz * (pool * (0.55 + 0.6 * from_key));
    light += (tone + frame.glow.xyz * pool) * (0.35 * pile * pile);
    // The foot of the curtain darkens towards the floor.
    light *= cavity * mix(0.55, 1.0, smoothstep(0.0, 0.5, p.y));
    let above = valance(arc, p.y, tone, frame.glow.xyz * exp(-0.5 * arc * arc));
    // Shadow of the valance on the cloth below.
    let shade = smoothstep(0.30, 0.0, 1.98 + 0.50 * pow(fract(arc / 1.16 + 0.5) - 0.5, 2.0) - p.y);
    return mix(light * (1.0 - 0.45 * shade), above.xyz, above.w);
}

// Blends in the colour of the fog for a point at `distance` metres.
fn fogged(light: vec3<f32>, distance: f32) -> vec3<f32> {
    let beyond = max(distance - length(frame.eye_in_world.xz - frame.stand.xz), 0.0);
    return mix(frame.fog.xyz, light, exp(-frame.fog.w * beyond));
}

// Wooden floor: tone in x, and 0 in the grooves in y.
fn planks(p: vec3<f32>, px: f32) -> vec2<f32> {
    let width = 0.14;
    let x = p.x / width;
    let plank = floor(x);
    let shift = hash_unit(vec3<i32>(i32(plank), 1, 1));
    let z = p.z / 1.9 + shift * 3.0;
    let tint = hash_unit(vec3<i32>(i32(plank), i32(floor(z)), 2));
    let grain = noise(vec3<f32>(p.x * 70.0, p.z * 3.5, tint * 31.0)) - 0.5;
    let seen = 1.0 - smoothstep(0.25, 1.0, px / 0.02);
    let edge = min(fract(x), 1.0 - fract(x)) * width;
    let butt = min(fract(z), 1.0 - fract(z)) * 1.9;
    let groove = min(smoothstep(0.0, 0.004 + px, edge), smoothstep(0.0, 0.004 + px, butt));
    return vec2<f32>((0.86 + 0.28 * tint + 0.30 * grain * seen) * mix(0.72, 1.0, groove), groove);
}

// Contact shadow of the soles on the floor; `share` is its strength.
fn contact_shade(p: vec3<f32>, share: f32) -> f32 {
    var contact = 1.0;
    for (var i = 0; i < 2; i++) {
        let d = (p - frame.feet[i].xyz) * vec3<f32>(1.0, 1.0, 0.55);
        contact *= 1.0 - share * exp(-dot(d, d) / 0.0075);
    }
    return contact;
}

fn boards(p: vec3<f32>, ray: vec3<f32>, distance: f32, at: vec2<f32>) -> vec3<f32> {
    let from_stand = p.xz - frame.stand.xz;
    let plank = planks(p, distance * frame.viewport.w * 1.2);
    let tone = frame.floor.xyz * plank.x;

    let pool = exp(-dot(from_stand, from_stand) * 0.55);
    let n = vec3<f32>(0.0, 1.0, 0.0);
    let share = key_share(p, n, at);
    let key = frame.key.xyz * (frame.key_dir.y * share * (0.10 + 0.95 * pool));
    let contact = contact_shade(p, 0.62);
    let body = 1.0 - 0.35 * exp(-dot(from_stand, from_stand) / 0.10);
    var light = tone * (key + (frame.sky.xyz * (0.25 + 0.45 * pool) + frame.glow.xyz) * (contact * body));

    // Waxed boards reflect the curtain faintly.
    let view = -normalize(ray);
    let f = fresnel(0.03, view.y);
    let r = vec3<f32>(ray.x, -ray.y, ray.z);
    let s = saturate1(1.0 - dot(p.xz, p.xz) / (CURTAIN_RADIUS * CURTAIN_RADIUS));
    let mirror_pool = exp(-p.x * p.x * 0.35) * (0.4 + 0.6 * s);
    let soft = mix(frame.backdrop_low.xyz, frame.backdrop_high.xyz, saturate1(r.y / max(length(r), 1e-3)))
        + frame.glow.xyz * mirror_pool;
    light += soft * (f * 1.4 * plank.y * contact);
    return light;
}

// A plain wall that blends into the floor; only the figure's shadow shows the boundary.
fn studio(ray: vec3<f32>, t_floor: f32, at: vec2<f32>) -> vec3<f32> {
    let up = normalize(ray).y;
    let wall = mix(frame.backdrop_low.xyz, frame.backdrop_high.xyz, smoothstep(-0.25, 0.35, up));
    let far = 6.0 + length(frame.eye_in_world.xz);
    if t_floor > 1e8 { return fogged(wall, far); }
    let p = frame.eye_in_world.xyz + ray * t_floor;
    let from_stand = p.xz - frame.stand.xz;
    let near = exp(-dot(from_stand, from_stand) * 0.9);
    let share = key_share(p, vec3<f32>(0.0, 1.0, 0.0), at);
    let light = wall * contact_shade(p, 0.5) * mix(1.0, 0.55 + 0.45 * share, near);
    return fogged(light, min(t_floor * length(ray), far));
}

@fragment
fn fs_theatre(v: TheatreOut) -> @location(0) vec4<f32> {
    let eye = frame.eye_in_world.xyz;
    // Curtain: a cylinder around the rest position of the figure.
    let o = eye.xz;
    let d = v.ray.xz;
    let a = max(dot(d, d), 1e-8);
    let b = dot(o, d);
    let c = dot(o, o) - CURTAIN_RADIUS * CURTAIN_RADIUS;
    let root = sqrt(max(b * b - a * c, 0.0));
    let t_curtain = (-b + root) / a;
    let t_floor = select(1e9, -eye.y / v.ray.y, v.ray.y < -1e-6 && eye.y > 0.0);
    var light: vec3<f32>;
    if frame.backdrop_low.w < 0.5 {
        return written(studio(v.ray, t_floor, v.clip.xy), 1.0, v.clip.xy);
    }
    // The floor outside the curtain, on the camera's side, is the front of the stage.
    if t_floor < t_curtain {
        let p = eye + v.ray * t_floor;
        light = boards(p, v.ray, t_floor * length(v.ray), v.clip.xy);
        // The boards darken towards the curtain's foot and the audience.
        light *= mix(1.0, 0.55, smoothstep(2.0, CURTAIN_RADIUS, length(p.xz)));
    } else {
        light = curtain(eye + v.ray * t_curtain, v.ray);
    }
    light = fogged(light, min(t_floor, t_curtain) * length(v.ray));
    return written(light, 1.0, v.clip.xy);
}
