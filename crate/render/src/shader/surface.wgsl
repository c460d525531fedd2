// Textures of a surface: colour and alpha, normals in tangent space, heights of wrinkles.

@group(2) @binding(0) var color_map: texture_2d<f32>;
@group(2) @binding(1) var normal_map: texture_2d<f32>;
@group(2) @binding(2) var map_sampler: sampler;
@group(2) @binding(3) var wrinkle_map: texture_2d<f32>;
// Strands of hair: coverage, height in the bundle, number.
@group(2) @binding(4) var strand_map: texture_2d<f32>;
@group(2) @binding(5) var strand_sampler: sampler;

// Colour and alpha of the surface, linear: the product of material, vertex and texture. The
// vertex's own alpha is occlusion.
fn painted(v: VertexOut) -> vec4<f32> {
    return textureSample(color_map, map_sampler, v.uv) * material.base * vec4<f32>(v.color.rgb, 1.0);
}

// Normal from the normal map around n, which faces the viewer. The files contain no tangents, so
// the frame follows from the screen-space derivatives of uv (Schüler 2013, "Followup: normal
// mapping without precomputed tangents"). +y runs along decreasing v, as in glTF.
fn mapped_normal(v: VertexOut, n: vec3<f32>) -> vec3<f32> {
    let m = textureSample(normal_map, map_sampler, v.uv).xyz * (255.0 / 127.0) - 128.0 / 127.0;
    let px = dpdx(v.world);
    let py = dpdy(v.world);
    let tx = dpdx(v.uv);
    let ty = dpdy(v.uv);
    let across = cross(py, n);
    let down = cross(n, px);
    // The frame's handedness is independent of the direction of the screen's y axis.
    let turn = sign(dot(px, across));
    let t = (across * tx.x + down * ty.x) * turn;
    let b = (across * tx.y + down * ty.y) * turn;
    let size = max(max(dot(t, t), dot(b, b)), 1e-30);
    return normalize(n * max(m.z, 0.05) + (t * m.x - b * m.y) * inverseSqrt(size));
}

@fragment
fn fs_plain(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let paint = painted(v);
    let n = mapped_normal(v, facing_normal(v.normal, front));
    let cover = cut(paint.a, fwidth(paint.a));
    let light = polished(v, n, paint.rgb, material.params.x);
    if material.params.z == 1.0 {
        // Blended over the background.
        return written(light * paint.a, paint.a, v.clip.xy);
    }
    if cover < 0.02 {
        discard;
    }
    return written(light, cover, v.clip.xy);
}

@fragment
fn fs_cut_shadow(v: ShadowOut) {
    if textureSample(color_map, map_sampler, v.uv).a < 0.5 {
        discard;
    }
}
