// Hair on cards, u across the card, v from root to tip; lashes and brows hair by hair.

struct Strand {
    cover: f32,   // 0..1
    id: f32,      // 0..1, one number a strand
};

// `count` strands across a card; `width_u` is the width of a pixel in u.
fn strand_row(uv: vec2<f32>, bend: f32, count: f32, width_u: f32) -> Strand {
    let x = (uv.x + bend) * count;
    let i = i32(floor(x));
    let id = hash_unit(vec3<i32>(i, 17, i32(count)));
    let end = 0.66 + 0.34 * fract(id * 53.0);
    // A strand tapers towards its end.
    let half_width = 0.62 * sqrt(saturate1(1.0 - uv.y / end)) + 0.02;
    let off = abs(fract(x) - 0.5);
    let soft = max(width_u * count, 0.12);
    let sharp = 1.0 - smoothstep(half_width - 0.5 * soft, half_width + 0.5 * soft, off);
    // Roots do not stand in line.
    let start = 0.07 * fract(id * 7.7);
    // The card's sides thin out, so that no card shows its outline.
    let side = min(uv.x, 1.0 - uv.x) + (id - 0.5) * 0.10;
    var s: Strand;
    s.cover = sharp * select(1.0, 0.0, uv.y > end)
        * smoothstep(start - 0.02, start + 0.02, uv.y) * smoothstep(-0.01, 0.16, side);
    s.id = id;
    return s;
}

// Strands too fine for the pixels gather into locks: 32, 16, 8 or 4 across, each row
// fading into the next with distance.
fn strand(uv: vec2<f32>, bind: vec3<f32>, width_u: f32) -> Strand {
    // Cards share one uv square: where the card lies makes it different from the next.
    let bend = 0.05 * sin(dot(bind, vec3<f32>(61.0, 23.0, 47.0)))
        + 0.03 * sin(dot(bind, vec3<f32>(-97.0, 41.0, 113.0)) + 1.0);
    let level = clamp(log2(max(width_u, 1e-6) * 32.0 * 1.5), 0.0, 3.0);
    let near = strand_row(uv, bend, exp2(5.0 - floor(level)), width_u);
    let next = strand_row(uv, bend, exp2(5.0 - min(floor(level) + 1.0, 3.0)), width_u);
    let fade = smoothstep(0.25, 0.75, fract(level));
    var s: Strand;
    s.cover = mix(near.cover, next.cover, fade);
    s.id = mix(near.id, next.id, fade);
    return s;
}

// Highlight of a cylinder along t (Kajiya and Kay 1989), with exponent e.
fn along_strand(t: vec3<f32>, h: vec3<f32>, e: f32) -> f32 {
    let th = dot(t, h);
    let sine = sqrt(max(1.0 - th * th, 0.0));
    return smoothstep(-1.0, 0.0, th) * pow(sine, e);
}

// Two lobes, the second tinted and shifted to the tip (Scheuermann 2004, "Practical
// real-time hair rendering and shading", after Marschner et al. 2003).
fn hair_lobes(t: vec3<f32>, n: vec3<f32>, view: vec3<f32>, l: vec3<f32>, tone: vec3<f32>, wobble: f32) -> vec3<f32> {
    let h = normalize(l + view);
    let white = along_strand(normalize(t + n * (-0.10 + wobble)), h, 110.0);
    let tinted = along_strand(normalize(t + n * (0.16 + wobble)), h, 22.0);
    return vec3<f32>(0.060 * white) + sqrt(tone) * (0.15 * tinted);
}

fn hair_light(v: VertexOut, n: vec3<f32>, tone: vec3<f32>, id: f32) -> vec3<f32> {
    let view = to_eye(v.world);
    let t = normalize(v.along + vec3<f32>(0.0, 1e-5, 0.0));
    let ao = v.color.a;
    // A small filter: strands break up the shadow's edge by themselves. Light seeps
    // through hair, so its own shadow is never black.
    let share = mix(0.16, 1.0, filtered_share(v.world, n, v.clip.xy, 1));
    let wobble = (id - 0.5) * 0.22;
    let key_in = share * saturate1(0.25 + 0.75 * dot(n, frame.key_dir.xyz));
    let fill_in = saturate1(0.3 + 0.7 * dot(n, frame.fill_dir.xyz));
    let rim_in = saturate1(0.2 + 0.8 * dot(n, frame.rim_dir.xyz));
    var light = tone * (frame.key.xyz * key_in + frame.fill.xyz * fill_in
        + frame.rim.xyz * (0.6 * rim_in) + ambient(n)) * (0.35 + 0.65 * ao) * ao;
    light += frame.key.xyz * hair_lobes(t, n, view, frame.key_dir.xyz, tone, wobble) * (key_in * PI * ao);
    light += frame.rim.xyz * hair_lobes(t, n, view, frame.rim_dir.xyz, tone, wobble) * (rim_in * PI * 1.1 * ao);
    return light;
}

// 1: coverage goes to the samples; 0: it is cut at a half.
override COVERAGE: u32 = 1u;

// Covers sharply whatever the distance (Golus 2017, "Anti-aliased alpha test").
fn cut(cover: f32, slope: f32) -> f32 {
    if COVERAGE == 1u {
        return saturate1((cover - 0.42) / max(slope, 0.25) + 0.5);
    }
    return select(0.0, 1.0, cover > 0.42);
}

@fragment
fn fs_hair(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let s = strand(v.uv, v.bind, length(vec2<f32>(dpdx(v.uv.x), dpdy(v.uv.x))));
    let cover = cut(s.cover, fwidth(s.cover)) * material.base.a;
    if cover < 0.05 {
        discard;
    }
    let n = facing_normal(v.normal, front);
    let tone = v.color.rgb * material.base.rgb * (0.70 + 0.60 * s.id) * mix(0.75, 1.15, v.uv.y);
    return written(hair_light(v, n, tone, s.id), cover, v.clip.xy);
}

// A lash or brow hair is a card of its own that tapers to a point.
@fragment
fn fs_lash(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let n = facing_normal(v.normal, front);
    let tone = v.color.rgb * material.base.rgb;
    // So fine a hair is shaded as a line in its surroundings' light; a lobe would sparkle.
    let share = key_share(v.world, n, v.clip.xy);
    let light = frame.key.xyz * (share * 0.55) + frame.fill.xyz * 0.5 + ambient(n);
    return written(tone * light * v.color.a, material.base.a, v.clip.xy);
}

@fragment
fn fs_hair_shadow(v: ShadowOut) {
    if strand(v.uv, v.bind, 0.02).cover < 0.4 {
        discard;
    }
}
