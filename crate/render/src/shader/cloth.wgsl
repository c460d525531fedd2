// Cloth and leather, and what polished surfaces share.

// Height of a knitted jersey: columns of V stitches; x and y in stitches. Slope in xy,
// height 0..1 in z.
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

// Soft light through the fibres that stand off the cloth: grazing views brighten
// (after the sheen of Estevez and Kulla 2017, in a cheap form).
fn fuzz(n: vec3<f32>, view: vec3<f32>) -> f32 {
    let x = 1.0 - saturate1(dot(n, view));
    return x * x * x;
}

@fragment
fn fs_cloth(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let q = v.uv * vec2<f32>(480.0, 620.0);
    let stitch_px = max(length(dpdx(q)), length(dpdy(q)));
    let view = to_eye(v.world);
    let ng = facing_normal(v.normal, front);
    var n = ng;
    var albedo = v.color.rgb * material.base.rgb;
    let up = normalize(v.along - n * dot(v.along, n) + vec3<f32>(0.0, 1e-6, 0.0));
    let right = cross(up, n);

    // Yarn is never even: broad, then finer mottling.
    let mottle = noise(v.bind * 90.0) * 0.5 + noise(v.bind * 420.0) * 0.5 - 0.5;
    albedo *= 1.0 + 0.16 * mottle;
    if FINE_DETAIL == 1u {
        let near = 1.0 - smoothstep(0.12, 0.40, stitch_px);
        if near > 0.0 {
            let k = knit(q);
            n = normalize(n - (right * k.x + up * k.y) * (0.13 * near));
            albedo *= mix(1.0, 0.66 + 0.5 * k.z, near);
        }
        let slub = 1.0 - smoothstep(0.3, 0.9, stitch_px * 0.4);
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

fn polished(v: VertexOut, n: vec3<f32>, albedo: vec3<f32>, rough: f32) -> vec3<f32> {
    let view = to_eye(v.world);
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
