// Skin and nails.

// Distance off the surface at which a point is past the skin's own curvature and sees the lamp just
// beyond the terminator, metres. Reference: a cheek, an arc of 80 mm, 3 mm at its end.
const BEND_LIFT = 0.005;

// Subsurface light. The cosine wraps around the terminator per channel, red furthest, and further
// at strong curvature (Penner 2011, "Pre-integrated skin shading", SIGGRAPH course; here in closed
// form). The reach per channel follows the widths of d'Eon and Luebke 2007 (GPU Gems 3, ch. 14):
// red scatters over 2.7 mm, green and blue over about 1.2 and 0.8 mm.
fn under_skin(ndl: vec3<f32>, share: f32, lifted: f32, bend: f32) -> vec3<f32> {
    // `bend` is the root of the curvature as a share of 250/m; a concave surface scatters no
    // further than a plane.
    let curve = 250.0 * max(bend, 0.0) * max(bend, 0.0);
    let wrap = vec3<f32>(0.10, 0.05, 0.035) + min(vec3<f32>(0.0027, 0.0012, 0.0008) * curve, vec3<f32>(0.40, 0.20, 0.14));
    let t = saturate((ndl + wrap) / (1.0 + wrap));
    // Rounded foot, with the energy of a cosine.
    let lit = mix(t, t * t * (1.5 - 0.5 * t), 0.5) / (1.0 + 0.35 * wrap);
    // A shadow's edge bleeds red. On a surface that turns from the lamp, the surface's own shadow
    // must not cut off the wrapped light. The shadow of another part, such as the jaw on the
    // throat, must.
    let s = max(share, lifted * (1.0 - smoothstep(-0.25, 0.10, ndl.x)));
    return lit * vec3<f32>(pow(s, 0.80), s, mix(s, s * s, 0.15));
}

// Transmission of light from behind, 0..1: ears and the wings of the nose, which are only flesh and
// cartilage. The rest of the head has bone, but the path through the mesh is also short along the
// edge of the jaw. Surfaces without a face are hands or feet.
fn lets_through(bind: vec3<f32>) -> f32 {
    let q = (bind - material.face.xyz) / max(material.face.w, 1e-3);
    let side = abs(q.x);
    // The jaw's angle is in front of the ear, the neck behind it.
    let ear = smoothstep(1.05, 1.2, side) * smoothstep(-0.85, -1.05, q.z) * smoothstep(-2.1, -1.9, q.z);
    let t = vec3<f32>(side - 0.24, q.y + 0.62, q.z - 0.45) / vec3<f32>(0.16, 0.22, 0.35);
    let wing = exp(-dot(t, t));
    // The distance from head to hands is more than a few eye distances.
    let beyond = smoothstep(4.0, 5.0, max(side, abs(q.y)));
    return select(1.0, max(ear * smoothstep(-1.35, -1.15, q.y), max(wing, beyond)), material.face.w > 0.0);
}

// Light through thin flesh from behind, red because of the blood.
fn shone_through(light: u32, p: vec3<f32>, n: vec3<f32>, l: vec3<f32>, at: vec2<f32>, through: f32) -> vec3<f32> {
    // Only beyond the edge of the shadow: at the edge even thick parts appear thin.
    let away = smoothstep(0.22, 0.75, -dot(n, l)) * through;
    if away <= 0.0 {
        return vec3<f32>(0.0);
    }
    let s = thinness(light, p - n * 0.0008, at);
    return vec3<f32>(0.62 * s, 0.24 * s * s, 0.13 * s * s * s) * (away * 0.4 * s);
}

// Mask of the region around the mouth, 0..1, for the lips: cheeks of dark skin are as red as lips.
fn about_mouth(bind: vec3<f32>) -> f32 {
    let q = (bind - material.face.xyz) / max(material.face.w, 1e-3);
    let near = smoothstep(0.75, 0.58, abs(q.x)) * smoothstep(0.46, 0.32, abs(q.y + 1.07));
    return select(0.0, near, material.face.w > 0.0);
}

// Oiliness of the skin, 0..1, by position on the face: forehead, nose and chin more than cheeks
// (the "T zone").
fn oiliness(bind: vec3<f32>) -> f32 {
    let q = (bind - material.face.xyz) / max(material.face.w, 1e-3);
    let middle = exp(-q.x * q.x * 5.0) * smoothstep(-2.0, -1.5, q.y) * smoothstep(1.9, 1.2, q.y);
    let brow = exp(-q.x * q.x * 0.9) * smoothstep(0.25, 0.6, q.y) * smoothstep(1.9, 1.2, q.y);
    return select(0.0, max(middle, 0.5 * brow), material.face.w > 0.0 && q.z > -0.6);
}

// Expressive wrinkles (F&H section 3.1.2), from a height map weighted by muscle contraction: xyz is
// the slope of the skin along itself, w the height in millimetres.
fn wrinkled(v: VertexOut, n: vec3<f32>) -> vec4<f32> {
    let px = dpdx(v.world);
    let py = dpdy(v.world);
    let tx = dpdx(v.uv);
    let ty = dpdy(v.uv);
    let strength = saturate(v.complexion.xyz);
    if max(strength.x, max(strength.y, strength.z)) < 0.004 {
        return vec4<f32>(0.0);
    }
    // Neighbouring texels to the right and left, below and above. The map repeats no more often
    // than the skin, so the mip level is that of the pixel.
    let texel = 1.0 / vec2<f32>(textureDimensions(wrinkle_map));
    let du = vec2<f32>(texel.x, 0.0);
    let dv = vec2<f32>(0.0, texel.y);
    let right = dot(textureSampleGrad(wrinkle_map, map_sampler, v.uv + du, tx, ty).rgb, strength);
    let left = dot(textureSampleGrad(wrinkle_map, map_sampler, v.uv - du, tx, ty).rgb, strength);
    let below = dot(textureSampleGrad(wrinkle_map, map_sampler, v.uv + dv, tx, ty).rgb, strength);
    let above = dot(textureSampleGrad(wrinkle_map, map_sampler, v.uv - dv, tx, ty).rgb, strength);
    let mm = 255.0 / 127.0;
    let height = mm * (0.25 * (right + left + below + above) - dot(strength, vec3<f32>(128.0 / 255.0)));
    let rise = (0.0005 * mm) * vec2<f32>(right - left, below - above) / texel;
    // Gradients of u and v over the surface, from screen-space derivatives (Mikkelsen 2010, "Bump
    // mapping unparametrized surfaces on the GPU").
    let across = cross(py, n);
    let down = cross(n, px);
    let area = dot(px, across);
    let whole = select(-1.0, 1.0, area >= 0.0) * max(abs(area), 1e-14);
    let slope = (across * dot(tx, rise) + down * dot(ty, rise)) / whole;
    // Derivatives are unreliable at grazing angles.
    return vec4<f32>(slope * min(1.0, 1.2 / max(length(slope), 1e-4)), height);
}

// Strength of a blush by position, 0..1: strongest on the cheeks, the tip of the nose and the ears,
// weaker on the forehead and the neck. Chosen by eye.
fn blushing(bind: vec3<f32>) -> f32 {
    let q = (bind - material.face.xyz) / max(material.face.w, 1e-3);
    let side = abs(q.x);
    let c = vec2<f32>(side - 0.78, q.y + 0.58) / vec2<f32>(0.50, 0.46);
    let cheek = exp(-dot(c, c)) * smoothstep(-0.9, -0.3, q.z);
    let t = vec2<f32>(q.x / 0.26, (q.y + 0.52) / 0.22);
    let nose = 0.85 * exp(-dot(t, t)) * smoothstep(0.1, 0.35, q.z);
    let ear = smoothstep(1.05, 1.25, side) * smoothstep(-0.7, -1.1, q.z) * smoothstep(-1.0, -0.7, q.y);
    let forehead = 0.38 * smoothstep(0.3, 0.9, q.y);
    return select(0.0, max(max(cheek, nose), max(0.85 * ear, max(forehead, 0.34))), material.face.w > 0.0);
}

// Relative colour of skin with e^x times its usual blood. Haemoglobin absorbs green and blue. The
// epidermis filters the result, so dark skin changes by the same share of less light. Closed form
// of pigment.rs in the figures' generator, for 1.1 % of blood; a test there verifies it to 3 %.
fn flushed(x: f32) -> vec3<f32> {
    return exp(vec3<f32>(-0.15, -0.65, -0.62) * (exp(0.5 * x) - 1.0));
}

// Share of the key light that lit cheeks and nose reflect into the orbit below the brow, where the
// skin faces down in its own shadow. Chosen by eye.
fn sent_back(bind: vec3<f32>, n: vec3<f32>) -> f32 {
    let q = (bind - material.face.xyz) / max(material.face.w, 1e-3);
    let t = vec2<f32>((abs(q.x) - 0.5) / 0.34, (q.y - 0.13) / 0.22);
    let orbit = exp(-dot(t, t)) * smoothstep(-0.9, -0.3, q.z);
    let down = saturate1(0.25 - dot(n, frame.head_up.xyz));
    return select(0.0, 0.85 * orbit * down, material.face.w > 0.0);
}

@fragment
fn fs_skin(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let footprint = length(fwidth(v.bind));
    let view = to_eye(v.world);
    let fold = wrinkled(v, facing_normal(v.normal, front));
    let ng = bumped(facing_normal(v.normal, front), fold.xyz);
    var n = mapped_normal(v, ng);
    var albedo = painted(v).rgb;
    // Less light reaches a furrow, and that light has passed more blood.
    let furrow = smoothstep(0.0, 0.5, -fold.w);
    let ao = v.color.a * (1.0 - 0.45 * furrow);
    let oil = oiliness(v.bind);
    // Lips are redder than other skin, smoother, and moist.
    let lip = smoothstep(0.36, 0.52, (albedo.r - albedo.g) / (albedo.r + albedo.g + 1e-4)) * about_mouth(v.bind);
    // Rolled-in lips are wet.
    let wet = lip * smoothstep(0.50, 0.62, (albedo.r - albedo.g) / (albedo.r + albedo.g + 1e-4));
    // Skin without fine relief is rougher: relief below the size of a pixel broadens the specular
    // lobe.
    var rough = max(material.params.x, 0.5) + 0.10 - 0.09 * oil - 0.20 * lip - 0.06 * wet;
    // White hairs of a beard do not blush.
    let bare = smoothstep(0.06, 0.2, (albedo.r - albedo.b) / (albedo.r + albedo.b + 1e-4));
    // Vessels dilate further than they constrict.
    let most = select(0.70, 1.05, v.complexion.w > 0.0) * blushing(v.bind);
    let blood = 0.5 * furrow + v.complexion.w * bare * mix(most, 0.5, lip);
    if abs(blood) > 0.002 {
        albedo *= flushed(blood);
    }

    // A normal map includes pores; the computed pores then only add grain.
    let own = mix(1.0, 0.35, material.params.w);
    // Blood and pigment vary over centimetres.
    let blotch = noise(v.bind * 60.0) * 0.6 + noise(v.bind * 170.0) * 0.4 - 0.5;
    albedo *= 1.0 + blotch * vec3<f32>(0.06, 0.13, 0.11) * own;
    // The oil film is uneven too, so a cheek does not shine uniformly.
    var sheen = 0.50 + 0.50 * (0.5 + blotch);

    if FINE_DETAIL == 1u {
        let pores = own * (1.0 - smoothstep(0.25, 0.7, footprint * 900.0));
        if pores > 0.0 {
            let a = noise_gradient(v.bind * 900.0);
            let b = noise_gradient(v.bind * vec3<f32>(2300.0, 1700.0, 2000.0));
            n = bumped(n, (a.xyz * 0.085 + b.xyz * 0.05) * pores);
            albedo *= 1.0 - 0.07 * pores * smoothstep(0.55, 0.9, a.w);
            rough += pores * (0.08 * (b.w - 0.5) - 0.03 * (1.0 - lip));
            // Pores hold no oil.
            sheen *= 1.0 - 0.45 * pores * smoothstep(0.50, 0.85, a.w);
        }
        // Lips fold across the mouth, a millimetre apart; the folds fan out towards the corners.
        let folds = lip * (1.0 - smoothstep(0.3, 0.9, footprint * 700.0));
        if folds > 0.0 {
            let q = (v.bind - material.face.xyz) / max(material.face.w, 1e-3);
            let fan = vec3<f32>(v.bind.x * (1.0 - 0.18 * abs(q.y + 1.05)), v.bind.y * 0.12, v.bind.z * 0.12);
            let fold = noise_gradient(fan * 1500.0);
            n = bumped(n, vec3<f32>(fold.x, 0.0, 0.0) * (0.14 * folds));
            albedo *= 1.0 - 0.10 * folds * smoothstep(0.55, 0.25, fold.w);
        }
        // Fine creases a few millimetres apart stay visible at medium distance.
        let creases = own * (1.0 - smoothstep(0.25, 0.7, footprint * 280.0));
        if creases > 0.0 {
            n = bumped(n, noise_gradient(v.bind * 280.0).xyz * (0.05 * creases));
        }
    }

    let key_l = frame.key_dir.xyz;
    let fill_l = frame.fill_dir.xyz;
    let rim_l = frame.rim_dir.xyz;
    let share = key_share(v.world, ng, v.clip.xy);
    let rim_in = rim_share(v.world, ng, v.clip.xy);
    // Only beyond the terminator: elsewhere the shadow map is sufficient.
    var key_lifted = 1.0;
    if dot(ng, key_l) < 0.10 {
        key_lifted = lifted_share(0u, v.world, ng, BEND_LIFT, v.clip.xy);
    }
    var rim_lifted = 1.0;
    if SHADOWS > 1u && dot(ng, rim_l) < 0.10 {
        rim_lifted = lifted_share(1u, v.world, ng, BEND_LIFT, v.clip.xy);
    }
    let occlusion = tinted_occlusion(ao, albedo);
    // Bumps show less in subsurface light than in specular light, least in red.
    let soft = vec3<f32>(0.35, 0.65, 0.8);
    let key_n = mix(vec3<f32>(dot(ng, key_l)), vec3<f32>(dot(n, key_l)), soft);
    let fill_n = mix(vec3<f32>(dot(ng, fill_l)), vec3<f32>(dot(n, fill_l)), soft);
    let rim_n = mix(vec3<f32>(dot(ng, rim_l)), vec3<f32>(dot(n, rim_l)), soft);

    var diffuse = frame.key.xyz * under_skin(key_n, share, key_lifted, v.bend) * mix(1.0, ao, 0.35);
    diffuse += frame.fill.xyz * under_skin(fill_n, 1.0, 1.0, v.bend) * occlusion;
    // At grazing rim light, the coarse shadow map would split the light into patches.
    let grazed = smoothstep(0.05, 0.45, dot(ng, rim_l));
    diffuse += frame.rim.xyz * under_skin(rim_n, rim_in, rim_lifted, v.bend) * (occlusion * occlusion * grazed);
    diffuse += ambient(normalize(mix(ng, n, 0.5))) * occlusion;
    diffuse += frame.key.xyz * albedo * sent_back(v.bind, ng);
    let through = lets_through(v.bind);
    diffuse += (frame.key.xyz * shone_through(0u, v.world, ng, key_l, v.clip.xy, through)
        + frame.rim.xyz * shone_through(1u, v.world, ng, rim_l, v.clip.xy, through)) * ao;

    // Two lobes, an oil film over rough skin, f0 0.028 (d'Eon and Luebke 2007).
    // Rough skin reflects less at grazing angles than Schlick's smooth surface.
    let f = mix(0.028, fresnel(0.028, dot(n, view)), 0.40);
    let tight = filtered_roughness(n, rough * mix(0.76, 0.62, lip));
    rough = filtered_roughness(n, rough);
    let film = 0.05 + 0.10 * oil + 0.34 * lip + 0.14 * wet;
    let key_s = mix(specular(n, view, key_l, rough), specular(n, view, key_l, tight), film);
    let fill_s = specular(n, view, fill_l, rough);
    let rim_s = specular(n, view, rim_l, rough);
    // The fill has no shadow map: ambient occlusion attenuates it in concave areas.
    var shine = frame.key.xyz * (key_s * share) + frame.fill.xyz * (fill_s * ao)
        + frame.rim.xyz * (rim_s * rim_in * ao);
    shine *= f * PI * 0.62 * ao * ao * mix(sheen, 1.0, lip);
    // The reflection of the room is weak: a stronger one would look like grey haze on the skin.
    shine += mirrored(reflect(-view, n)) * (f * ao * ao * ao * mix(0.22, 0.45, max(0.7 * oil, lip)));

    return written(albedo * diffuse + shine, 1.0, v.clip.xy);
}

@fragment
fn fs_nail(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let view = to_eye(v.world);
    let n = facing_normal(v.normal, front);
    let albedo = painted(v).rgb;
    let share = key_share(v.world, n, v.clip.xy);
    let occlusion = tinted_occlusion(v.color.a, albedo);
    // The nail bed glows through the plate: light scatters far below it.
    var light = albedo * (frame.key.xyz * under_skin(vec3<f32>(dot(n, frame.key_dir.xyz)), share, share, 0.7)
        + frame.fill.xyz * under_skin(vec3<f32>(dot(n, frame.fill_dir.xyz)), 1.0, 1.0, 0.7) * occlusion
        + ambient(n) * occlusion);
    let gloss = filtered_roughness(n, 0.34);
    // A rough plate reflects less at grazing angles than Schlick's smooth surface. Its edge, less
    // than a pixel wide, is visible only at grazing angles.
    let f = mix(0.045, fresnel(0.045, dot(n, view)), 0.3 * (1.0 - gloss));
    light += (frame.key.xyz * (specular(n, view, frame.key_dir.xyz, gloss) * share)
        + frame.fill.xyz * (specular(n, view, frame.fill_dir.xyz, gloss) * v.color.a)) * (f * PI);
    light += mirrored(reflect(-view, n)) * (f * v.color.a);
    return written(light, 1.0, v.clip.xy);
}
