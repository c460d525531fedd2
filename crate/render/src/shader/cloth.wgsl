// Cloth and leather, and functions shared by polished surfaces.

// Height field of a knitted jersey: columns of V stitches; x and y are in stitches. Every weave
// returns the slope in xy and the height 0..1 in z.
fn knit(q: vec2<f32>) -> vec3<f32> {
    let column = fract(q.x) - 0.5;
    // Each leg of the V leans towards the middle of its column.
    let y = q.y + abs(column) * 1.1;
    let leg = cos(2.0 * PI * y);
    let rib = cos(2.0 * PI * column);
    let height = 0.5 + 0.25 * leg + 0.25 * rib;
    let leg_slope = -0.5 * PI * sin(2.0 * PI * y);
    return vec3<f32>(leg_slope * 1.1 * sign(column) - 0.5 * PI * sin(2.0 * PI * column), leg_slope, height);
}

// Rounded ridges along y.
fn ridges(x: f32) -> vec3<f32> {
    return vec3<f32>(-PI * sin(2.0 * PI * x), 0.0, 0.5 + 0.5 * cos(2.0 * PI * x));
}

// Woven threads that pass over and under; twill shifts by one thread per row.
fn threads(q: vec2<f32>, twill: f32) -> vec3<f32> {
    let d = 2.0 * PI * (q.x + q.y * twill);
    let e = 2.0 * PI * q.y;
    let plain = (1.0 - twill) * sin(e);
    return vec3<f32>(-PI * sin(d), -PI * sin(d) * twill - 0.8 * PI * plain, 0.5 + 0.3 * cos(d) + 0.2 * cos(e));
}

// Repeats per metre of each weave: knit, rib, woven, denim, corduroy, fleece.
const REPEATS = array<vec2<f32>, 6>(
    vec2<f32>(480.0, 620.0), vec2<f32>(185.0, 620.0), vec2<f32>(900.0, 900.0),
    vec2<f32>(560.0, 560.0), vec2<f32>(300.0, 300.0), vec2<f32>(800.0, 1000.0));

// Wales per metre of a jersey.
const WALES = 165.0;

fn weave_of(kind: u32, q: vec2<f32>) -> vec3<f32> {
    switch kind {
        case 1u: {
            // Ribs are coarse enough to show single stitches.
            let k = knit(q * vec2<f32>(2.0, 1.0));
            let r = ridges(q.x);
            return vec3<f32>(r.xy * 1.5 + k.xy * 0.3, r.z * 0.75 + k.z * 0.25);
        }
        case 2u: { return threads(q, 0.0); }
        case 3u: { return threads(q, 1.0); }
        case 4u: { return ridges(q.x) * vec3<f32>(1.2, 1.0, 1.0); }
        default: { return knit(q); }
    }
}

// Soft light from fibres that stand off the cloth: brightens grazing views (simplified from the
// sheen of Estevez and Kulla 2017).
fn fuzz(n: vec3<f32>, view: vec3<f32>) -> f32 {
    let x = 1.0 - saturate1(dot(n, view));
    return x * x * x;
}

@fragment
fn fs_cloth(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let kind = u32(material.params.w + 0.5);
    var repeats = REPEATS;
    let q = v.uv * repeats[kind];
    let repeat_px = max(length(dpdx(q)), length(dpdy(q)));
    let view = to_eye(v.world);
    let ng = cloth_normal(v, front);
    var n = ng;
    var albedo = v.color.rgb * material.base.rgb;
    let up = normalize(v.along - n * dot(v.along, n) + vec3<f32>(0.0, 1e-6, 0.0));
    let right = cross(up, n);
    let is_denim = kind == 3u;

    // Yarn is uneven: broad mottling, then finer mottling. Denim fades on convex bends.
    let mottle = noise(v.bind * 90.0) * 0.5 + noise(v.bind * 420.0) * 0.5 - 0.5;
    albedo *= 1.0 + select(0.16, 0.34, is_denim) * mottle;
    if is_denim {
        let worn = noise(v.bind * vec3<f32>(9.0, 5.0, 9.0)) - 0.45 + (v.color.a - 0.75) * 0.9;
        albedo = mix(albedo, albedo * 1.5 + 0.012, saturate1(worn));
    }
    if FINE_DETAIL == 1u {
        // Hanging folds: down the body, across a sleeve.
        let sleeve = smoothstep(0.20, 0.27, abs(v.bind.x));
        let hang = noise_gradient(v.bind * mix(vec3<f32>(19.0, 5.0, 19.0), vec3<f32>(27.0, 11.0, 11.0), sleeve));
        let slack = mix(1.0, 0.55, f32(kind == 0u || kind == 1u)) * mix(mix(0.7, 1.0, smoothstep(1.32, 1.12, v.bind.y)), 1.9, sleeve);
        n = bumped(n, hang.xyz * mix(vec3<f32>(1.0, 0.3, 1.0), vec3<f32>(1.0, 0.45, 0.45), sleeve) * (0.42 * slack));
        // Occlusion at the bottom of the folds.
        albedo *= 1.0 - 0.22 * min(slack, 1.0) * smoothstep(0.55, 0.20, hang.w);
        // Small creases, below the resolution of the mesh; knits hardly crease.
        let crisp = select(0.10, 0.24, kind == 2u || is_denim || kind == 4u);
        n = bumped(n, noise_gradient(v.bind * vec3<f32>(44.0, 62.0, 44.0)).xyz * crisp);
        let near = 1.0 - smoothstep(0.14, 0.46, repeat_px);
        if near > 0.0 {
            let k = weave_of(kind, q);
            n = normalize(n - (right * k.x + up * k.y) * (0.13 * near));
            albedo *= mix(1.0, 0.66 + 0.5 * k.z, near);
        }
        // Wales of a jersey, visible at distances at which single stitches are not.
        let wale = v.uv.x * WALES;
        let wale_px = length(vec2<f32>(dpdx(wale), dpdy(wale)));
        let seen = f32(kind == 0u) * (1.0 - smoothstep(0.20, 0.42, wale_px)) * mix(0.6, 1.0, smoothstep(0.03, 0.10, wale_px));
        if seen > 0.0 {
            let r = ridges(wale + 0.10 * noise(v.bind * 60.0));
            n = normalize(n - right * (r.x * 0.070 * seen));
            albedo *= 1.0 - 0.19 * seen * (1.0 - r.z);
        }
        let slub = 1.0 - smoothstep(0.3, 0.9, repeat_px * 0.4);
        n = bumped(n, noise_gradient(v.bind * vec3<f32>(160.0, 240.0, 160.0)).xyz * (0.05 * slub));
    }

    let share = key_share(v.world, ng, v.clip.xy);
    let ao = v.color.a;
    let occlusion = tinted_occlusion(ao, albedo);
    let wrap = 0.15;
    let key_d = saturate1((dot(n, frame.key_dir.xyz) + wrap) / (1.0 + wrap));
    let fill_d = saturate1((dot(n, frame.fill_dir.xyz) + wrap) / (1.0 + wrap));
    let rim_d = saturate1((dot(n, frame.rim_dir.xyz) + wrap) / (1.0 + wrap));
    var light = albedo * (frame.key.xyz * (key_d * share)
        + (frame.fill.xyz * fill_d + ambient(n)) * occlusion
        + frame.rim.xyz * (rim_d * ao * ao));
    let sheen = fuzz(n, view) * ao;
    let lit = frame.key.xyz * (share * saturate1(0.4 + 0.6 * dot(n, frame.key_dir.xyz)))
        + frame.rim.xyz * saturate1(0.5 + 0.5 * dot(n, frame.rim_dir.xyz)) + ambient(n);
    light += (albedo * 0.5 + 0.03) * lit * sheen;
    return written(light, 1.0, v.clip.xy);
}

fn polished(v: VertexOut, n: vec3<f32>, albedo: vec3<f32>, roughness: f32) -> vec3<f32> {
    let view = to_eye(v.world);
    let rough = filtered_roughness(n, roughness);
    let share = key_share(v.world, n, v.clip.xy);
    let occlusion = tinted_occlusion(v.color.a, albedo);
    var light = albedo * (frame.key.xyz * (saturate1(dot(n, frame.key_dir.xyz)) * share)
        + (frame.fill.xyz * saturate1(dot(n, frame.fill_dir.xyz)) + ambient(n)) * occlusion
        + frame.rim.xyz * (saturate1(dot(n, frame.rim_dir.xyz)) * v.color.a));
    let f = fresnel(0.04, dot(n, view));
    light += (frame.key.xyz * (specular(n, view, frame.key_dir.xyz, rough) * share)
        + frame.fill.xyz * specular(n, view, frame.fill_dir.xyz, rough)
        + frame.rim.xyz * specular(n, view, frame.rim_dir.xyz, rough)) * (f * PI * v.color.a);
    light += mirrored(reflect(-view, n)) * (f * (1.0 - 0.7 * rough) * v.color.a);
    return light;
}

@fragment
fn fs_leather(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    var n = facing_normal(v.normal, front);
    let fade = 1.0 - smoothstep(0.3, 0.8, length(fwidth(v.bind)) * 500.0);
    if FINE_DETAIL == 1u && fade > 0.0 {
        n = bumped(n, noise_gradient(v.bind * 500.0).xyz * (0.12 * fade));
    }
    return written(polished(v, n, v.color.rgb * material.base.rgb, material.params.x), 1.0, v.clip.xy);
}
