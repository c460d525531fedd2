// Rendering of the figure without its materials: as edges and vertices, or in clay. Also renders
// the overlays: bones, frames, joints and targets.

// 1: clay. 0: the colours of the materials.
override CLAY: u32 = 0u;
// 1: edges and vertices. Those on the far side are omitted, because they would hide the shape.
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
    // Half of a line's colour is fixed, so that dark cloth stays visible in front of a dark
    // curtain. Dense lines are partly transparent, so that the mesh stays legible.
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

// 1: the parts of lines that are behind a surface.
override BEHIND: u32 = 0u;

// Four corners of a line: a band of its width in pixels. The ends extend slightly, so that a line
// of zero length is a dot.
@vertex
fn vs_line(
    @builtin(vertex_index) corner: u32,
    @location(0) line_from: vec3<f32>,
    @location(1) line_to: vec3<f32>,
    @location(2) color: vec4<f32>,
    @location(3) width: f32,
) -> OverOut {
    var a = frame.clip_from_world * vec4<f32>(line_from, 1.0);
    var b = frame.clip_from_world * vec4<f32>(line_to, 1.0);
    // Lines next to or behind the camera are clipped.
    let near = 0.02;
    if max(a.w, b.w) < near {
        return OverOut(vec4<f32>(0.0, 0.0, 2.0, 1.0), vec4<f32>(0.0));
    }
    if a.w < near {
        a = mix(a, b, (near - a.w) / max(b.w - a.w, 1e-6));
    }
    if b.w < near {
        b = mix(b, a, (near - b.w) / max(a.w - b.w, 1e-6));
    }
    let run = (b.xy / b.w - a.xy / a.w) * frame.viewport.xy;
    let along = select(vec2<f32>(1.0, 0.0), normalize(run), dot(run, run) > 1e-6);
    let beyond = select(-along, along, corner > 1u);
    let aside = vec2<f32>(-along.y, along.x) * select(-1.0, 1.0, (corner & 1u) == 1u);
    var p = select(a, b, corner > 1u);
    // Fades towards the far side of the figure.
    let fade = 1.0 - 0.85 * smoothstep(-0.02, 0.10, p.w - frame.head_up.w);
    p = vec4<f32>(p.xy + (beyond + aside) * (width * frame.viewport.zw * p.w), p.zw);
    let cover = color.a * fade * select(1.0, 0.4, BEHIND == 1u);
    return OverOut(p, vec4<f32>(color.rgb, cover));
}

@fragment
fn fs_line(v: OverOut) -> @location(0) vec4<f32> {
    let light = v.color.rgb / max(frame.ground.w, 1e-3);
    return written(light * v.color.a, v.color.a, v.clip.xy);
}

// Cancels the exposure, so that the brightness is the same in every light.
@fragment
fn fs_over(v: OverOut) -> @location(0) vec4<f32> {
    return written(v.color.rgb / max(frame.ground.w, 1e-3), 1.0, v.clip.xy);
}
