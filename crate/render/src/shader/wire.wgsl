// Edges of the triangles over the drawn figure; native only.

@vertex
fn vs_wire(v: VertexIn) -> @builtin(position) vec4<f32> {
    let m = blend(v.joint, v.weight);
    let clip = frame.clip_from_world * vec4<f32>(place(m, vec4<f32>(v.position, 1.0)), 1.0);
    // Half a millimetre nearer, at a metre or two, than the surface it lies on.
    return vec4<f32>(clip.xy, clip.z - 0.00003 * clip.w, clip.w);
}

@fragment
fn fs_wire(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    return written(vec3<f32>(0.004), 0.65, at.xy);
}
