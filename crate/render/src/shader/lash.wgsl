// Lashes and brows as single hairs. Each hair is a ribbon turned to the viewer and rendered one
// pixel wider than it is. Its coverage of a pixel is the hair's share of the pixel's width. Hairs
// thinner than a pixel therefore fade, with or without multisampling, instead of breaking into
// dots.

// uv.x encodes the half width: 0.5 more is half a millimetre to that side of the centre line.
const HAIR_REACH_M = 1e-3;
// Half widths below this are the tip, whose coordinate is rounded.
const HAIR_TIP_M = 4e-6;
// Offset of hairs in front of the surface below them; a turned ribbon would intersect it.
const HAIR_LIFT_M = 6e-4;

@vertex
fn vs_lash(v: VertexIn) -> VertexOut {
    return as_hair(v, placed(v, v.position, v.normal, vec4<f32>(0.0)));
}

@vertex
fn vs_bound_lash(v: VertexIn, t: TissueIn) -> VertexOut {
    return as_hair(v, placed(v, v.position + displacement(t), v.normal + turn(t), vec4<f32>(0.0)));
}

// Returns the hair's vertex: uv.x is the distance from the centre line and `bend` the width, in
// pixels.
fn as_hair(v: VertexIn, card: VertexOut) -> VertexOut {
    var o = card;
    let aside = (v.uv.x - 0.5) * HAIR_REACH_M;
    let half_width = select(0.0, abs(aside), abs(aside) > HAIR_TIP_M);
    let across = normalize(cross(card.along, card.normal) + vec3<f32>(0.0, 0.0, 1e-6));
    let middle = card.world - across * sign(aside) * half_width;
    let view = to_eye(middle);
    let aslant = cross(card.along, view);
    let to_side = aslant / max(length(aslant), 1e-4);
    let c = frame.clip_from_world;
    let depth = dot(vec4<f32>(c[0].w, c[1].w, c[2].w, c[3].w), vec4<f32>(middle, 1.0));
    let zoom = length(vec3<f32>(c[0].y, c[1].y, c[2].y));
    let pixels_per_m = 0.5 * zoom * frame.viewport.y / max(depth, 1e-3);
    let half_pixels = half_width * pixels_per_m;
    let reach = select(0.0, half_pixels + 0.5, half_width > 0.0) * sign(aside);
    o.world = middle + to_side * (reach / pixels_per_m);
    o.clip = c * vec4<f32>(o.world, 1.0);
    let lifted = c * vec4<f32>(o.world + view * HAIR_LIFT_M, 1.0);
    o.clip.z = lifted.z / lifted.w * o.clip.w;
    o.uv = vec2<f32>(reach, v.uv.y);
    o.bend = 2.0 * half_pixels;
    return o;
}

@fragment
fn fs_lash(v: VertexOut) -> @location(0) vec4<f32> {
    let cover = clamp(0.5 * v.bend - abs(v.uv.x) + 0.5, 0.0, min(v.bend, 1.0));
    // Darker at the root, so that a hair appears to grow out of the skin.
    let rooted = mix(0.72, 1.0, smoothstep(0.0, 0.12, v.uv.y));
    let alpha = cover * rooted * v.color.a * material.base.a;
    let outward = normalize(v.normal);
    let n = select(-outward, outward, dot(outward, to_eye(v.world)) > 0.0);
    let tone = v.color.rgb * material.base.rgb * mix(0.92, 1.12, v.uv.y);
    // Fine hairs are shaded as lines in the ambient light; a specular lobe would sparkle.
    let facing = saturate1(0.5 + 0.5 * dot(n, frame.key_dir.xyz));
    let share = key_share(v.world, n, v.clip.xy) * mix(0.2, 0.75, facing);
    // Light passes through pale hair and lights it from within.
    let pale = 1.0 + 0.45 * saturate1(2.0 * tone.g - 0.2);
    let light = (frame.key.xyz * share + frame.fill.xyz * 0.5 + ambient(n)) * pale;
    let seen = written(tone * light, alpha, v.clip.xy);
    return vec4<f32>(seen.rgb * alpha, alpha);
}
