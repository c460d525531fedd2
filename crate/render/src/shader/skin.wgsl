// Skin, nails.

// Diffuse light that has travelled under the skin: the cosine wraps around the
// terminator by channel, red furthest, energy-conserving (wrap after Green 2004, GPU
// Gems ch. 16; widths by channel after the profile of d'Eon and Luebke 2007, GPU Gems 3
// ch. 14, chosen by eye). `share` is the key's shadow.
fn under_skin(ndl: f32, share: f32) -> vec3<f32> {
    let wrap = vec3<f32>(0.30, 0.14, 0.09);
    let lit = clamp((ndl + wrap) / ((1.0 + wrap) * (1.0 + 0.5 * wrap)), vec3<f32>(0.0), vec3<f32>(1.0));
    // A shadow's edge bleeds red (Penner 2011, "Pre-integrated skin shading"). Where the
    // surface turns from the lamp its own shadow must not cut off the wrapped light.
    let s = max(share, 1.0 - smoothstep(-0.25, 0.12, ndl));
    return lit * vec3<f32>(pow(s, 0.74), s, mix(s, s * s, 0.2));
}

@fragment
fn fs_skin(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let footprint = length(fwidth(v.bind));
    let view = to_eye(v.world);
    let ng = facing_normal(v.normal, front);
    var n = mapped_normal(v, ng);
    var albedo = painted(v).rgb;
    let ao = v.color.a;
    var rough = max(material.params.x, 0.5);

    // Blood and pigment vary over centimetres.
    let blotch = noise(v.bind * 60.0) * 0.6 + noise(v.bind * 170.0) * 0.4 - 0.5;
    albedo *= 1.0 + blotch * vec3<f32>(0.06, 0.12, 0.11);

    if FINE_DETAIL == 1u {
        let pores = 1.0 - smoothstep(0.25, 0.7, footprint * 900.0);
        if pores > 0.0 {
            let a = noise_gradient(v.bind * 900.0);
            let b = noise_gradient(v.bind * vec3<f32>(2300.0, 1700.0, 2000.0));
            n = bumped(n, (a.xyz * 0.085 + b.xyz * 0.05) * pores);
            albedo *= 1.0 - 0.06 * pores * smoothstep(0.55, 0.9, a.w);
            rough += 0.06 * pores * (b.w - 0.5);
        }
        // Fine creases a few millimetres apart hold at medium distance.
        let creases = 1.0 - smoothstep(0.25, 0.7, footprint * 280.0);
        if creases > 0.0 {
            n = bumped(n, noise_gradient(v.bind * 280.0).xyz * (0.05 * creases));
        }
    }

    let key_l = frame.key_dir.xyz;
    let share = key_share(v.world, ng, v.clip.xy);
    let occlusion = tinted_occlusion(ao, albedo);
    // Bumps show less in the light from below the skin than in the shine.
    let nd = normalize(mix(ng, n, 0.5));

    var diffuse = frame.key.xyz * under_skin(dot(nd, key_l), share);
    diffuse += frame.fill.xyz * under_skin(dot(nd, frame.fill_dir.xyz), 1.0) * occlusion;
    diffuse += frame.rim.xyz * under_skin(dot(nd, frame.rim_dir.xyz), 1.0) * (occlusion * occlusion);
    diffuse += ambient(nd) * occlusion;

    // Two lobes, oily film over rough skin, f0 0.028 (d'Eon and Luebke 2007).
    // Rough skin mirrors less at grazing angles than Schlick's smooth surface.
    let f = mix(0.028, fresnel(0.028, dot(n, view)), 0.45);
    let tight = rough * 0.66;
    let key_s = mix(specular(n, view, key_l, rough), specular(n, view, key_l, tight), 0.16);
    let fill_s = specular(n, view, frame.fill_dir.xyz, rough);
    let rim_s = specular(n, view, frame.rim_dir.xyz, rough);
    var shine = frame.key.xyz * (key_s * share) + frame.fill.xyz * fill_s
        + frame.rim.xyz * (rim_s * ao);
    shine *= f * PI * 0.72 * ao * ao;
    let r = reflect(-view, n);
    shine += mirrored(r) * (f * 0.55 * ao * ao) * (1.0 - 0.5 * rough);

    return written(albedo * diffuse + shine, 1.0, v.clip.xy);
}

@fragment
fn fs_nail(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let view = to_eye(v.world);
    let n = facing_normal(v.normal, front);
    let albedo = painted(v).rgb;
    let share = key_share(v.world, n, v.clip.xy);
    let occlusion = tinted_occlusion(v.color.a, albedo);
    var light = albedo * (frame.key.xyz * under_skin(dot(n, frame.key_dir.xyz), share)
        + frame.fill.xyz * under_skin(dot(n, frame.fill_dir.xyz), 1.0) + ambient(n) * occlusion);
    let f = fresnel(0.045, dot(n, view));
    let gloss = 0.32;
    light += (frame.key.xyz * (specular(n, view, frame.key_dir.xyz, gloss) * share)
        + frame.fill.xyz * specular(n, view, frame.fill_dir.xyz, gloss)) * (f * PI);
    light += mirrored(reflect(-view, n)) * (f * v.color.a);
    return written(light, 1.0, v.clip.xy);
}
