// The globe with sclera, iris and pupil, and the wet layer over it.

// Sizes on the uv disc, in units of the globe's radius (12 mm). Iris: 11.8 mm across (Caroline and
// Andre 2002: corneal diameter 11.8 mm). Cornea: radius of curvature 7.8 mm, refractive index with
// the aqueous 1.336 (Gullstrand's eye).
const IRIS = 0.47;
const CORNEA_OVER_GLOBE = 1.54;
const AQUEOUS = 1.336;
// Distance of the iris plane in front of the globe's centre.
const IRIS_PLANE = 0.845;

// Distance of a point beyond the edge of a lid, in globe radii; positive on the covered side.
// Without lids, the result is that of a half-open eye.
fn over_edge(v: VertexOut, lower: u32) -> f32 {
    let left = v.bind.x > material.face.x;
    let lid = frame.lids[select(2u, 0u, left) + lower];
    let up = dot(normalize(v.normal), frame.head_up.xyz);
    let bare = select(up - 0.42, -up - 0.45, lower == 1u);
    return select(bare, (dot(v.world, lid.xyz) + lid.w) / 0.012, dot(lid.xyz, lid.xyz) > 0.5);
}

// Share of light left by lids and lashes: a soft shadow below the upper lid, darkest at its edge,
// and a weaker shadow above the lower lid.
fn lid_shade(v: VertexOut) -> f32 {
    let off = over_edge(v, 0u);
    let upper = 0.30 * smoothstep(-0.55, 0.0, off) + 0.38 * smoothstep(-0.22, 0.0, off);
    let lower = smoothstep(-0.14, 0.03, over_edge(v, 1u));
    return (1.0 - upper) * (1.0 - 0.32 * lower);
}

// Tear film at the edge of the lower lid: a rim half a millimetre high that reflects the upper
// surroundings.
fn meniscus(v: VertexOut) -> f32 {
    let d = over_edge(v, 1u) - 0.01;
    return 0.4 * exp(-d * d * 4200.0);
}

// Corneal normal: the bulge over the iris has a stronger curvature than the globe.
fn corneal_normal(n: vec3<f32>, right: vec3<f32>, up: vec3<f32>, d: vec2<f32>) -> vec3<f32> {
    let bulge = 1.0 - smoothstep(IRIS * 0.95, IRIS * 1.25, length(d));
    let steeper = (right * d.x + up * d.y) * ((CORNEA_OVER_GLOBE - 1.0) * bulge);
    return normalize(n + steeper);
}

fn eye_lights(v: VertexOut, n: vec3<f32>, view: vec3<f32>, share: f32) -> vec3<f32> {
    let r = reflect(-view, n);
    let f = fresnel(0.04, dot(n, view));
    // The reflection of the lamp has constant strength: a catch-light makes the gaze readable from
    // every angle. The lid hides its upper part. The second lamp is reflected small and dim on the
    // far side.
    let open = 1.0 - smoothstep(-0.14, -0.02, over_edge(v, 0u));
    let lamp = lamp_share(r, frame.key_dir.xyz, 0.30) * (0.45 + 0.55 * share) * open;
    var light = frame.key.xyz * (1.15 * lamp);
    light += frame.fill.xyz * (0.55 * lamp_share(r, frame.fill_dir.xyz, 0.22) * open);
    light += frame.key.xyz * (specular(n, view, frame.key_dir.xyz, 0.10) * f * share);
    light += frame.fill.xyz * (specular(n, view, frame.fill_dir.xyz, 0.16) * f * PI);
    // Lashes darken the upper part of the reflection.
    light += mirrored(r) * (f * 0.6 * open);
    let wet = meniscus(v);
    light += (ambient(frame.head_up.xyz) * 0.7 + frame.key.xyz * (0.20 * share)) * wet;
    return light * (0.45 + 0.55 * lid_shade(v));
}

// Tone of brown and blue irises: radial fibres with pits between them, a lighter collarette around
// the pupil and a dark ring at the rim. `at` is in iris radii.
fn iris_tone(at: vec2<f32>, tone: vec3<f32>) -> vec3<f32> {
    let r = length(at);
    let pupil = frame.eyes.x / IRIS;
    let outwards = at / max(r, 1e-4);
    let spokes = vec3<f32>(outwards * 13.0, r * 1.5);
    let warp = noise(vec3<f32>(at * 5.0, 1.0)) * 0.8;
    let coarse = noise(spokes + warp);
    let fine = noise(vec3<f32>(outwards * 34.0, r * 2.2 + warp));
    let pits = smoothstep(0.62, 0.80, noise(vec3<f32>(at * 6.5, 7.0))) * smoothstep(0.45, 0.6, r);
    var c = tone * (0.50 + 0.75 * coarse + 0.65 * (fine - 0.3)) * (1.0 - 0.55 * pits);
    // The collarette is at about a third of the distance from the pupil to the rim.
    let frill = smoothstep(0.31, 0.11, r - pupil + 0.10 * (coarse - 0.5));
    c = mix(c, c * vec3<f32>(1.55, 1.25, 0.85) + vec3<f32>(0.020, 0.012, 0.004), frill * 0.6);
    c *= mix(1.0, 0.20, smoothstep(0.72, 0.98, r));
    let edge = fwidth(r) + 0.03;
    return c * smoothstep(pupil - edge, pupil + edge, r);
}

@fragment
fn fs_eye(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let view = to_eye(v.world);
    let n = facing_normal(v.normal, front);
    let along = normalize(v.along - n * dot(v.along, n));
    let across = cross(along, n);
    let d = (v.uv - 0.5) * 2.0;
    let r = length(d);
    // Axes of the eye, from the position on the globe: (d, z) is the unit radius.
    let z = sqrt(max(1.0 - r * r, 0.0));
    let a = normalize(vec2<f32>(z, -d.y) + vec2<f32>(1e-5, 0.0));
    let axis = n * z + along * a.y - across * (a.x * d.x);
    let up = n * d.y + along * a.x + across * (a.y * d.x);
    let right = n * d.x + across * (a.x * z - a.y * d.y);

    // The view ray refracts at the cornea and meets the iris plane behind it.
    let eye_view = vec3<f32>(dot(view, right), dot(view, up), dot(view, axis));
    let bulged = normalize(vec3<f32>(d * mix(1.0, CORNEA_OVER_GLOBE, 1.0 - smoothstep(IRIS * 0.9, IRIS * 1.2, r)), z));
    let inside = refract(-eye_view, bulged, 1.0 / AQUEOUS);
    let depth = max(z - IRIS_PLANE, 0.0) + 0.02;
    let under = d + inside.xy * (depth / max(-inside.z, 0.3));
    let at = under / IRIS;
    let iris = iris_tone(at, material.base.rgb * v.color.rgb);

    // Sclera: ivory, pinker outwards, with veins towards the corners, which the surrounding skin
    // shades.
    var sclera = mix(vec3<f32>(0.46, 0.425, 0.40), vec3<f32>(0.40, 0.29, 0.26), smoothstep(0.50, 1.0, r));
    sclera *= 1.0 - 0.45 * smoothstep(0.45, 0.95, abs(d.x));
    let warp = noise(v.bind * 900.0) * 0.9;
    let vein = abs(noise(vec3<f32>(d.x * 5.0, d.y * 16.0 + warp, 3.0)) - 0.5);
    sclera = mix(sclera, vec3<f32>(0.58, 0.26, 0.22),
        0.28 * smoothstep(0.05, 0.0, vein) * smoothstep(0.5, 0.95, r));
    // The limbus is soft: the sclera thins over 1 mm and shows the dark ring below it.
    let limbus = smoothstep(0.88, 1.16, r / IRIS + 0.04 * (noise(vec3<f32>(d * 9.0, 2.0)) - 0.5));
    let albedo = mix(iris, sclera, limbus);

    let share = key_share(v.world, n, v.clip.xy);
    let shade = lid_shade(v) * v.color.a;
    let l = frame.key_dir.xyz;
    // Light refracted by the cornea gathers on the far side of the iris.
    let far_side = -dot(at, vec2<f32>(dot(l, right), dot(l, up)));
    let gathered = 0.70 + 0.85 * saturate1(far_side);
    let wrap = vec3<f32>(0.42, 0.34, 0.30);
    let key_d = saturate((dot(n, l) + wrap) / (1.0 + wrap));
    var diffuse = frame.key.xyz * key_d * (mix(share, 1.0, 0.12) * mix(gathered, 1.0, limbus));
    diffuse += frame.fill.xyz * saturate1((dot(n, frame.fill_dir.xyz) + 0.3) / 1.3);
    diffuse += ambient(n);
    // Light that passes the lids is tinted by flesh.
    var light = albedo * diffuse * mix(vec3<f32>(1.0, 0.86, 0.80), vec3<f32>(1.0), shade) * shade;
    if material.params.y < 0.5 {
        light += eye_lights(v, corneal_normal(n, right, up, d), view, share) * v.color.a;
    }
    return written(light, 1.0, v.clip.xy);
}

@fragment
fn fs_cornea(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let view = to_eye(v.world);
    let n = facing_normal(v.normal, front);
    let share = key_share(v.world, n, v.clip.xy);
    let light = eye_lights(v, n, view, share) * v.color.a;
    // Premultiplied with zero coverage, so the result is additive.
    return written(light, 0.0, v.clip.xy);
}
