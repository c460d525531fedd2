// The figure without its surfaces, edges and corners alone or cast in clay; and what is
// drawn over it: bones, frames, joints, targets.

// 1: of clay. 0: in the paint of its materials.
override CLAY: u32 = 0u;
// 1: edges and corners. Those on the far side are left out, else no shape can be made out.
override THIN: u32 = 0u;

@fragment
fn fs_bare(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let paint = select(painted(v).rgb, vec3<f32>(0.34, 0.32, 0.30), CLAY == 1u);
    if THIN == 0u {
        return written(polished(v, facing_normal(v.normal, front), paint, 0.62), 1.0, v.clip.xy);
    }
    let facing = dot(normalize(v.normal), to_eye(v.world));
    if facing < 0.0 {
        discard;
    }
    // Dark cloth before a dark curtain would be lost: half of a line's colour is its own.
    // Where lines are dense they let each other through, so that the net stays a net.
    let light = mix(paint, vec3<f32>(0.85), 0.5) * (0.35 + 0.65 * facing);
    return written(light / max(frame.ground.w, 1e-3), 0.6, v.clip.xy);
}

struct OverOut {
    @builtin(position) clip: vec4<f32>,
    @location(0) color: vec4<f32>,
};

@vertex
fn vs_over(@location(0) p: vec3<f32>, @location(1) color: vec4<f32>) -> OverOut {
    return OverOut(frame.clip_from_world * vec4<f32>(p, 1.0), color);
}

// Drawn as bright in every light: exposure is taken back.
@fragment
fn fs_over(v: OverOut) -> @location(0) vec4<f32> {
    return written(v.color.rgb / max(frame.ground.w, 1e-3), 1.0, v.clip.xy);
}
