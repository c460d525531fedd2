// Teeth, gums and tongue: wet, in the shadow of the lips.

fn wet(v: VertexOut, n: vec3<f32>, albedo: vec3<f32>, wrap: f32, gloss: f32) -> vec3<f32> {
    let view = to_eye(v.world);
    // Without shadow maps, a constant share accounts for the shadow of the lips.
    let share = select(key_share(v.world, n, v.clip.xy), 0.35, SHADOWS < 1u);
    // Little light passes between lips that are hardly open.
    let ao = v.color.a * (1.0 - 0.88 * exp(-0.6 * frame.eyes.y));
    let occlusion = tinted_occlusion(ao, albedo);
    let key_d = saturate1((dot(n, frame.key_dir.xyz) + wrap) / (1.0 + wrap));
    let fill_d = saturate1((dot(n, frame.fill_dir.xyz) + wrap) / (1.0 + wrap));
    // The cavity receives ambient light from the front only.
    let front = 0.35 + 0.65 * saturate1(n.z);
    var light = albedo * (frame.key.xyz * (key_d * mix(share, 1.0, 0.12) * ao)
        + (frame.fill.xyz * fill_d + ambient(n) * front) * occlusion);
    let f = fresnel(0.035, dot(n, view));
    light += (frame.key.xyz * (specular(n, view, frame.key_dir.xyz, gloss) * share)
        + frame.fill.xyz * specular(n, view, frame.fill_dir.xyz, gloss)) * (f * PI * ao * ao);
    light += mirrored(reflect(-view, n)) * (f * 0.6 * ao * ao);
    return light;
}

@fragment
fn fs_teeth(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let n = facing_normal(v.normal, front);
    let albedo = painted(v).rgb;
    return written(wet(v, n, albedo, 0.45, 0.28), 1.0, v.clip.xy);
}

@fragment
fn fs_mouth(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    var n = facing_normal(v.normal, front);
    let fade = 1.0 - smoothstep(0.3, 0.8, length(fwidth(v.bind)) * 700.0);
    if FINE_DETAIL == 1u && fade > 0.0 {
        n = bumped(n, noise_gradient(v.bind * 700.0).xyz * (0.14 * fade));
    }
    let albedo = painted(v).rgb;
    return written(wet(v, n, albedo, 0.25, 0.34), 1.0, v.clip.xy);
}
