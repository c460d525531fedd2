// Set "garden": lawn, hedge, trees, and the near boughs of an apple tree.

// Tone of the grass, about 1.
fn grass(p: vec3<f32>, px: f32) -> f32 {
    let broad = patches(vec2<f32>(0.8 * p.x + 0.6 * p.z, 0.8 * p.z - 0.6 * p.x) * 1.7);
    let fine = patches(p.xz * vec2<f32>(52.0, 21.0)) - 0.5;
    let seen = 1.0 - smoothstep(0.4, 2.0, px / 0.02);
    return 0.82 + 0.36 * broad + 0.9 * fine * seen;
}

// Trees and sky by direction, in radians: azimuth in x, elevation in y.
fn trees(q: vec2<f32>, blur: f32) -> vec3<f32> {
    let low = frame.backdrop_low.xyz;
    let broad = patches(q * vec2<f32>(13.0, 17.0) + 3.3);
    let leaves = patches(q * 46.0);
    // Tree crowns of several heights, with sky between them.
    let crown = 0.085 + 0.10 * patches(vec2<f32>(q.x * 7.0 + 0.4, 0.5)) + 0.05 * (broad - 0.5) + 0.02 * (leaves - 0.5);
    let cover = smoothstep(-1.6 * blur - 0.004, 1.6 * blur + 0.004, crown - q.y);
    let sky = frame.backdrop_high.xyz * mix(vec3<f32>(1.0), vec3<f32>(0.80, 0.88, 0.98), saturate1(q.y * 4.0));
    // Light shines through from above.
    let thin = smoothstep(0.12, 0.0, crown - q.y);
    var leaf = low * (0.55 + 0.75 * broad + 0.30 * leaves) + frame.glow.xyz * (0.04 + 0.13 * thin) * (0.35 + broad);
    let radius = min(0.6 * blur + 0.004, 0.013);
    let shine = 0.8 * discs(q, 0.034, radius * 0.8, 0.35 * radius, 11)
        + discs(q + 0.017, 0.061, radius * 1.5, 0.4 * radius, 12);
    leaf += frame.glow.xyz * (shine * (0.07 + 0.38 * thin) * smoothstep(0.0, 0.07, q.y));
    return mix(sky, leaf, cover);
}

// The trunk of an apple tree at the right and its overhanging boughs; w is the coverage.
fn apple_tree(ray: vec3<f32>) -> vec4<f32> {
    let low = frame.backdrop_low.xyz;
    let at = upright(ray, -1.5);
    if at.z < 0.0 {
        return vec4<f32>(0.0);
    }
    let blur = edge_blur(at.z * length(ray));
    let p = at.xy;
    // The trunk leans, and forks above the figure's head.
    let lean = 1.02 - 0.10 * (p.y - 1.0) + 0.03 * sin(p.y * 3.1);
    let x = p.x - lean;
    let wide = 0.115 - 0.018 * p.y;
    let fork = from_piece(p, vec2<f32>(0.98, 1.55), vec2<f32>(0.30, 2.45)) - 0.050;
    let trunk = max(within(x, wide, blur), smoothstep(blur, -blur, fork));
    let bark = patches(vec2<f32>(x * 46.0, p.y * 9.0));
    // The sun is behind the tree, at the right.
    let side = smoothstep(-wide, wide, x);
    let wood = low * vec3<f32>(1.25, 0.86, 1.0) * (0.55 + 0.6 * bark) * (0.6 + 0.5 * side) + frame.glow.xyz * (0.20 * side * side * side);
    var seen = vec4<f32>(wood, trunk);
    let there = 0.95 * smoothstep(1.72, 2.12, p.y + 0.16 * p.x + 0.05 * sin(p.x * 9.0));
    let leaf = foliage(p, there, blur);
    seen = mix(seen, vec4<f32>(low * leaf.x + frame.glow.xyz * vec3<f32>(0.26, 0.34, 0.10) * leaf.y, 1.0), leaf.z);
    return seen;
}

// Roses in the hedge: a few per bush, red, pink and white.
fn roses(p: vec2<f32>, blur: f32) -> vec4<f32> {
    let q = p / 0.24;
    let cell = floor(q);
    let id = vec3<i32>(vec2<i32>(cell), 71);
    let at = (vec2<f32>(hash_unit(id), hash_unit(id + vec3<i32>(0, 0, 2))) - 0.5) * 0.46;
    let d = length(q - cell - 0.5 - at) * 0.24;
    let bush = smoothstep(0.50, 0.66, patches(p * vec2<f32>(1.3, 1.9) + 7.0));
    let there = step(0.22, hash_unit(id + vec3<i32>(0, 0, 3))) * bush;
    let dye = hash_unit(id + vec3<i32>(0, 0, 4));
    let color = mix(mix(vec3<f32>(0.42, 0.045, 0.06), vec3<f32>(0.60, 0.22, 0.27), step(0.4, dye)), vec3<f32>(0.62, 0.56, 0.48), step(0.75, dye));
    let size = 0.024 + 0.012 * dye;
    // Limits the blur, so that the edge of its bush never cuts off a rose, however near the focus
    // is.
    let soft = min(0.7 * blur, 0.030);
    let shade = 0.55 + 0.55 * smoothstep(-size, size, (q - cell - 0.5 - at).y * 0.24);
    return vec4<f32>(color * shade, smoothstep(size + soft, size - soft, d) * there * min(1.0, 0.5 + size / max(2.0 * blur, 1e-3)));
}

@fragment
fn fs_garden(v: TheatreOut) -> @location(0) vec4<f32> {
    let eye = frame.eye_in_world.xyz;
    let level = max(length(v.ray.xz), 1e-4);
    let q = vec2<f32>(atan2(v.ray.x, -v.ray.z), v.ray.y / level);
    let t_floor = floor_time(v.ray);
    let t_hedge = round_time(v.ray, 7.0, 12.6);
    let scale = length(v.ray);
    let p = eye + v.ray * min(t_floor, t_hedge);
    let distance = min(t_floor, t_hedge) * scale;
    let blur = edge_blur(distance);
    var light: vec3<f32>;
    if t_floor < t_hedge {
        let px = distance * frame.viewport.w * 1.2 + blur;
        light = frame.floor.xyz * (grass(p, px) * floor_light(p, v.clip.xy, 0.72));
        // Dappled light; the lawn at the hedge is as dark as the foot of the hedge.
        light *= 0.72 + 0.62 * smoothstep(0.15, 0.95, patches(vec2<f32>(0.6 * p.x - 0.8 * p.z, 0.9 * p.z) * 0.9 + 2.0));
        let from_hedge = 12.6 - length(p.xz - vec2<f32>(0.0, 7.0));
        light = mix(frame.backdrop_low.xyz * 0.28, light, smoothstep(0.0, 1.9, from_hedge));
        light = fogged(light, distance);
    } else {
        // The hedge, and the distance above it. Rotated against the grid of the noise, so that no
        // rows appear.
        let h = vec2<f32>(0.8 * p.x + 0.6 * p.y, 0.8 * p.y - 0.6 * p.x);
        let leaves = patches(h * 10.0) * 0.4 + patches(h.yx * 3.7) * 0.6;
        let top = 1.34 + 0.14 * leaves;
        // The sun lights the upper leaves of the hedge.
        let sunny = smoothstep(-0.42, 0.06, p.y - top) * (0.3 + 0.7 * leaves);
        let tone = (0.50 + 0.5 * leaves) * mix(0.36, 1.15, smoothstep(0.0, 1.0, p.y));
        let arc = atan2(p.x, 7.0 - p.z) * 12.6;
        let rose = roses(vec2<f32>(arc, p.y), blur);
        let green = frame.glow.xyz * (0.13 * sunny) + frame.backdrop_low.xyz * tone;
        let hedge = mix(green, rose.xyz * mix(0.5, 1.0, smoothstep(0.2, 1.1, p.y)), rose.w);
        let cover = smoothstep(-blur - 0.02, blur + 0.02, top - p.y);
        light = mix(fogged(trees(q, far_blur()), distance + 2.0), fogged(hedge, distance), cover);
    }
    let tree = apple_tree(v.ray);
    light = mix(light, fogged(tree.xyz, 5.0), tree.w);
    return written(light, 1.0, v.clip.xy);
}

