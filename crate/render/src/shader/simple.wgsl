// Lowest quality, rendered on a CPU: the colour of the surface in the light of three lamps and the
// room, without shadows or specular light, encoded immediately.

fn room(n: vec3<f32>) -> vec3<f32> {
    let c = frame.ambient;
    return max((c[0] + c[1] * n.y + c[2] * n.z + c[3] * n.x).xyz, vec3<f32>(0.0));
}

// Diffuse light on a surface; `wrap` is its extent past the terminator. The key has no shadows, so
// occlusion replaces a part of them.
fn lit_simply(n: vec3<f32>, ao: f32, wrap: f32) -> vec3<f32> {
    let facing = vec3<f32>(dot(n, frame.key_dir.xyz), dot(n, frame.fill_dir.xyz), dot(n, frame.rim_dir.xyz));
    let d = saturate((facing + wrap) / (1.0 + wrap));
    return frame.key.xyz * (d.x * (0.25 + 0.75 * ao)) + (frame.fill.xyz * d.y + room(n)) * ao
        + frame.rim.xyz * (d.z * ao * ao * 0.6);
}

// Mean effect of shadows on a face, less that of specular light: measured on six figures, whose
// mean colour then equals that of the highest quality.
const SHADED = vec3<f32>(0.92, 0.925, 0.945);

@fragment
fn fs_simple_skin(v: VertexOut) -> @location(0) vec4<f32> {
    let light = lit_simply(normalize(v.normal), v.color.a, 0.12) * SHADED;
    return vec4<f32>(encoded_simply(painted(v).rgb * light), 1.0);
}

@fragment
fn fs_simple_cloth(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let n = cloth_normal(v, front);
    return vec4<f32>(encoded_simply(v.color.rgb * material.base.rgb * lit_simply(n, v.color.a, 0.15)), 1.0);
}

@fragment
fn fs_simple_hair(v: VertexOut) -> @location(0) vec4<f32> {
    // Single hairs, the last strips of the atlas, would break into dots.
    if v.uv.x > 0.75 {
        discard;
    }
    let p = textureSample(strand_map, strand_sampler, v.uv);
    let cover = cut(p.r, fwidth(p.r));
    if cover < 0.02 {
        discard;
    }
    let hull = normalize(v.normal);
    let open = v.color.a * v.color.a;
    let tone = strand_tone(v, p.b) * mix(0.5, 1.06, smoothstep(0.12, 0.85, p.g));
    let lamps = vec3<f32>(
        hair_through(open, hull, frame.key_dir.xyz),
        hair_through(open, hull, frame.fill_dir.xyz),
        hair_through(open, hull, frame.rim_dir.xyz),
    );
    let facing = vec3<f32>(dot(hull, frame.key_dir.xyz), dot(hull, frame.fill_dir.xyz), dot(hull, frame.rim_dir.xyz));
    let d = saturate((facing + 0.45) / 1.45) * lamps;
    let light = frame.key.xyz * d.x + frame.fill.xyz * d.y + frame.rim.xyz * d.z + room(hull) * (1.5 * open);
    return vec4<f32>(encoded_simply(tone * light), cover);
}
