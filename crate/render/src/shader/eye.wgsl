// The globe with sclera, iris and pupil, and the wet layer over it.

// Sizes in units of the globe's radius (12 mm) on the uv disc: the iris is 11.8 mm
// across (Caroline and Andre 2002: corneal diameter 11.8 mm), the cornea's radius of
// curvature 7.8 mm (Gullstrand's eye).
const IRIS = 0.47;
const PUPIL = 0.17;
const CORNEA_OVER_GLOBE = 1.54;

// Lids and lashes shade the globe from above, a little from below.
fn lid_shade(n: vec3<f32>) -> f32 {
    return mix(0.34, 1.0, smoothstep(0.55, -0.08, n.y)) * mix(0.8, 1.0, smoothstep(-0.6, -0.2, n.y));
}

// Corneal normal: the bulge over the iris is steeper than the globe.
fn corneal_normal(n: vec3<f32>, right: vec3<f32>, up: vec3<f32>, d: vec2<f32>) -> vec3<f32> {
    let bulge = 1.0 - smoothstep(IRIS * 0.95, IRIS * 1.25, length(d));
    let steeper = (right * d.x + up * d.y) * ((CORNEA_OVER_GLOBE - 1.0) * bulge);
    return normalize(n + steeper);
}

fn eye_lights(n: vec3<f32>, view: vec3<f32>, share: f32) -> vec3<f32> {
    let r = reflect(-view, n);
    let f = fresnel(0.04, dot(n, view));
    // The window is held at a constant strength: a catch-light is what makes an eye look
    // at someone, whatever the angle.
    let window = window_share(r) * (0.35 + 0.65 * share);
    var light = frame.key.xyz * (0.85 * window);
    light += frame.key.xyz * (specular(n, view, frame.key_dir.xyz, 0.12) * f * share);
    light += frame.fill.xyz * (specular(n, view, frame.fill_dir.xyz, 0.16) * f * PI);
    light += mirrored(r) * (f * 0.5);
    return light;
}

@fragment
fn fs_eye(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let view = to_eye(v.world);
    let n = facing_normal(v.normal, front);
    let up = normalize(v.along - n * dot(v.along, n));
    let right = cross(up, n);
    let d = (v.uv - 0.5) * 2.0;
    let r = length(d);

    // The iris lies about 3 mm behind the cornea: shift the look-up along the refracted view.
    let slant = vec2<f32>(dot(view, right), dot(view, up));
    let under = d - slant * (0.10 * (1.0 - smoothstep(IRIS * 0.6, IRIS * 1.05, r)));
    let ri = length(under) / IRIS;
    let outwards = under / max(length(under), 1e-4);

    // Sclera: ivory, pinker outwards, with veins towards the corners.
    var sclera = mix(vec3<f32>(0.66, 0.61, 0.57), vec3<f32>(0.58, 0.42, 0.37), smoothstep(0.6, 1.0, r));
    let warp = noise(v.bind * 900.0) * 0.9;
    let vein = abs(noise(vec3<f32>(d.x * 5.0, d.y * 16.0 + warp, 3.0)) - 0.5);
    sclera = mix(sclera, vec3<f32>(0.60, 0.27, 0.23),
        0.30 * smoothstep(0.05, 0.0, vein) * smoothstep(0.5, 0.95, r));

    // Iris: radial fibres, a lighter ruff around the pupil, dark limbal ring.
    let spokes = vec3<f32>(outwards * 14.0, ri * 1.6);
    let fibres = noise(spokes) * 0.6 + noise(spokes * vec3<f32>(2.3, 2.3, 1.7)) * 0.4;
    let tone = material.base.rgb * v.color.rgb;
    var iris = tone * (0.45 + 1.25 * fibres);
    let ruff = smoothstep(0.75, 0.42, ri);
    iris = mix(iris, iris * vec3<f32>(1.5, 1.2, 0.8) + vec3<f32>(0.02, 0.012, 0.004), ruff * 0.55);
    iris *= mix(1.0, 0.22, smoothstep(0.74, 1.0, ri));
    let edge = fwidth(ri) + 0.04;
    let pupil = smoothstep(PUPIL / IRIS - edge, PUPIL / IRIS + edge, ri);
    iris *= pupil;

    let limbus = smoothstep(0.90, 1.10, length(d) / IRIS);
    let albedo = mix(iris, sclera, limbus);

    let share = key_share(v.world, n, v.clip.xy);
    let shade = lid_shade(n) * v.color.a;
    let l = frame.key_dir.xyz;
    // Light enters the cornea and gathers on the far side of the iris.
    let gathered = 0.75 + 0.6 * saturate1(-dot(outwards, vec2<f32>(dot(l, right), dot(l, up))) * ri);
    let wrap = saturate1((dot(n, l) + 0.35) / 1.35);
    var diffuse = frame.key.xyz * (wrap * share * mix(gathered, 1.0, limbus));
    diffuse += frame.fill.xyz * saturate1((dot(n, frame.fill_dir.xyz) + 0.3) / 1.3);
    diffuse += ambient(n);
    var light = albedo * diffuse * shade;
    if material.params.y < 0.5 {
        light += eye_lights(corneal_normal(n, right, up, d), view, share) * (0.4 + 0.6 * shade);
    }
    return written(light, 1.0, v.clip.xy);
}

@fragment
fn fs_cornea(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let view = to_eye(v.world);
    let n = facing_normal(v.normal, front);
    let share = key_share(v.world, n, v.clip.xy);
    let light = eye_lights(n, view, share) * (0.4 + 0.6 * lid_shade(n)) * v.color.a;
    // Premultiplied with no cover of its own: only adds.
    return written(light, 0.0, v.clip.xy);
}
