// Hair on cards, v from root to tip. 64 columns of cards lie side by side in u: 0-39 dense,
// 40-53 loose, 54-62 single hairs, 63 the cap of short hair on the scalp, whose v is the
// share it covers. Lashes and brows hair by hair.

const COLUMNS = 64.0;
const CAP = 63.0;

struct Strand {
    cover: f32,   // 0..1
    id: f32,      // 0..1, one number a strand
    round: f32,   // -1..1 across a strand
};

// Smooth noise along a row, 0..1.
fn lock_noise(x: f32, dice: f32) -> f32 {
    let q = x + 61.0 * dice;
    let i = floor(q);
    let f = q - i;
    let a = hash_unit(vec3<i32>(i32(i), 29, 3));
    let b = hash_unit(vec3<i32>(i32(i) + 1, 29, 3));
    return mix(a, b, f * f * (3.0 - 2.0 * f));
}

// The remaining contrast of a row when `blur` of its hairs fit a pixel.
fn kept(blur: f32) -> f32 {
    return 1.0 - smoothstep(0.25, 1.1, blur);
}

// Hairs side by side at `x` along a row of `count`: height of the nearest above its
// neighbours (0..1), its number, and where across it we are.
fn hair_row(x: f32, count: f32, dice: f32) -> vec3<f32> {
    let q = x * count + 40.0 * dice;
    let i = floor(q);
    let f = q - i;
    let id = hash_unit(vec3<i32>(i32(i), 17, i32(count)));
    // Hairs are of different thickness and do not stand in the middle of their lanes.
    let off = (f - 0.5 - 0.24 * (fract(id * 31.7) - 0.5)) * 2.0;
    return vec3<f32>(saturate1(1.0 - off * off), id, off);
}

// The strand at a place on a card; `width_u` is the width of a pixel in u over a column.
fn strand(uv: vec2<f32>, width_u: f32) -> Strand {
    let at = uv.x * COLUMNS;
    let column = floor(at);
    let x = at - column;
    let v = uv.y;
    let dice = hash_unit(vec3<i32>(i32(column), 5, 11));
    let loose = step(40.0, column);
    let wisp = step(54.0, column);
    // Hairs gather towards the middles of locks and cross a little on their way.
    let gather = 0.045 * sin(6.2832 * (x * 2.6 + dice)) * v * v;
    let drift = (0.05 + 0.05 * wisp) * sin(v * (2.0 + 2.0 * dice) + 6.2832 * dice) * v;
    let y = x + gather + drift;
    // Single hairs, finer locks and locks; each fades to its mean as pixels grow over it.
    let count = mix(32.0, mix(24.0, 7.0, wisp), loose);
    let row = hair_row(y, count, dice);
    let hairs = kept(width_u * count);
    let fine = lock_noise(y * 15.0, dice) - 0.5;
    let fine_kept = kept(width_u * 15.0);
    let lock = lock_noise(y * 5.0, dice + 0.37) - 0.5;
    let value = 0.5 + hairs * 0.75 * (row.x - 0.6) + fine_kept * 0.75 * fine + 0.35 * lock;
    // How much is empty: past the ends of the hairs, which differ, at the sides, at the
    // root, between single hairs.
    let ends = 0.80 + 0.22 * lock + 0.26 * fine + mix(0.16, 0.55, wisp) * hairs * (row.y - 0.5) - 0.06 * wisp;
    let tip = smoothstep(ends - 0.34, ends + 0.06, v) + smoothstep(0.93, 1.0, v);
    let side = 1.0 - smoothstep(0.0, mix(0.26, 0.34, loose), min(x, 1.0 - x) + 0.10 * lock);
    // Short: on a long card a tenth is centimetres of bare parting.
    let root = 1.0 - smoothstep(0.0, 0.05 + 0.25 * wisp + 0.03 * fine + 0.04 * hairs * (row.y - 0.5), v);
    let base = 0.15 * (loose - wisp) + 0.52 * wisp;
    let there = (1.0 - saturate1(tip)) * (1.0 - side) * (1.0 - root) * (1.0 - base);
    // Where half is there, every second hair stands; far off, half a hair everywhere.
    let sharp = 1.0 + 2.2 * max(hairs, 0.6 * fine_kept);
    var s: Strand;
    s.cover = saturate1((value + there - 1.0) * sharp + mix(0.5, there, 0.35))
        * smoothstep(0.01, 0.12, there);
    s.id = saturate1(0.5 + 0.30 * lock + 0.45 * fine_kept * fine + 0.55 * hairs * (row.y - 0.5));
    s.round = row.z * hairs;
    return s;
}

// The cap: short hairs that stand closer the more of the skin they cover.
fn stubble(share: f32, bind: vec3<f32>) -> Strand {
    let q = vec3<f32>(bind.x, bind.y * 0.45, bind.z * 0.7) * 1400.0;
    let n = noise(q) * 0.6 + noise(q * 0.31) * 0.4;
    var s: Strand;
    let full = share * share * (3.0 - 2.0 * share);
    s.cover = saturate1(full + 2.4 * (n - 0.5) * full * (1.0 - full));
    s.id = n;
    s.round = 0.0;
    return s;
}

fn strand_or_cap(uv: vec2<f32>, bind: vec3<f32>, width_u: f32) -> Strand {
    if uv.x * COLUMNS >= CAP {
        return stubble(uv.y, bind);
    }
    return strand(uv, width_u);
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
    let white = along_strand(normalize(t + n * (-0.10 + wobble)), h, 80.0);
    let tinted = along_strand(normalize(t + n * (0.18 + wobble)), h, 16.0);
    return vec3<f32>(0.030 * white) + pow(tone, vec3<f32>(0.75)) * (0.20 * tinted);
}

// Light that comes through hair from behind, most where hair is pale and thin.
fn through_hair(view: vec3<f32>, l: vec3<f32>, tone: vec3<f32>, thin: f32) -> vec3<f32> {
    let facing = saturate1(-dot(view, l));
    return tone * sqrt(tone) * (0.9 * facing * facing * thin);
}

fn hair_light(v: VertexOut, n: vec3<f32>, tone: vec3<f32>, s: Strand) -> vec3<f32> {
    let view = to_eye(v.world);
    let t = normalize(v.along + vec3<f32>(0.0, 1e-5, 0.0));
    let ao = v.color.a;
    // A small filter: strands break up the shadow's edge by themselves. Light seeps
    // through hair, so its own shadow is never black.
    let pale = saturate1(2.0 * tone.g);
    let share = mix(mix(0.36, 0.60, pale), 1.0, filtered_share(v.world, n, v.clip.xy));
    let wobble = (s.id - 0.5) * 0.22;
    let key_in = share * saturate1(0.28 + 0.72 * dot(n, frame.key_dir.xyz));
    let fill_in = saturate1(0.3 + 0.7 * dot(n, frame.fill_dir.xyz));
    let rim_in = saturate1(0.15 + 0.85 * dot(n, frame.rim_dir.xyz));
    var light = tone * (frame.key.xyz * key_in + frame.fill.xyz * fill_in
        + frame.rim.xyz * (0.45 * rim_in) + ambient(n));
    // Pale hair passes light on into its depth.
    light *= mix(vec3<f32>((0.6 + 0.4 * ao) * ao), vec3<f32>(sqrt(ao)), saturate(1.7 * tone));
    light += frame.key.xyz * hair_lobes(t, n, view, frame.key_dir.xyz, tone, wobble) * (key_in * PI * ao * ao);
    light += frame.rim.xyz * hair_lobes(t, n, view, frame.rim_dir.xyz, tone, wobble) * (rim_in * PI * 0.8 * ao * ao);
    light += frame.rim.xyz * through_hair(view, frame.rim_dir.xyz, tone, ao * ao);
    return light;
}

// 1: coverage goes to the samples; 0: it is cut at a half.
override COVERAGE: u32 = 1u;

// Covers sharply whatever the distance (Golus 2017, "Anti-aliased alpha test").
fn cut(cover: f32, slope: f32) -> f32 {
    if COVERAGE == 1u {
        return saturate1((cover - 0.42) / max(slope, 0.6) + 0.5);
    }
    return select(0.0, 1.0, cover > 0.42);
}

// Covers softly. Four samples know five shares; a pattern over the pixels gives those
// between (Jimenez 2014, "Next generation post processing in Call of Duty").
fn thin_out(cover: f32, pixel: vec2<f32>) -> f32 {
    let pattern = fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715)))) - 0.5;
    if COVERAGE == 1u {
        return saturate1(cover + 0.14 * pattern * smoothstep(0.0, 0.15, cover * (1.0 - cover)));
    }
    return select(0.0, 1.0, cover > 0.45 + 0.3 * pattern);
}

@fragment
fn fs_hair(v: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let width_u = COLUMNS * length(vec2<f32>(dpdx(v.uv.x), dpdy(v.uv.x)));
    let s = strand_or_cap(v.uv, v.bind, width_u);
    let is_cap = v.uv.x * COLUMNS >= CAP;
    // A card seen edge-on would be a wire: it gives way to those that face the viewer.
    let flat = normalize(cross(dpdx(v.world), dpdy(v.world)));
    let faces = select(smoothstep(0.03, 0.24, abs(dot(flat, to_eye(v.world)))), 1.0, is_cap);
    let cover = thin_out(s.cover * faces, v.clip.xy) * material.base.a;
    if cover < 0.05 {
        discard;
    }
    var n = facing_normal(v.normal, front);
    let across = cross(v.along, n);
    n = normalize(n + across * (0.35 * s.round));
    // Hair is darker in its depth, at the roots.
    let own = v.color.rgb * material.base.rgb;
    let pale = saturate1(2.0 * own.g);
    // Fine hair at the line has no depth.
    let thin = step(40.0 / COLUMNS, v.uv.x);
    let roots = mix(mix(0.90, 0.95, max(pale, thin)), 1.03, smoothstep(0.0, 0.4, v.uv.y));
    let depth = select(roots, mix(0.6, 0.9, pale), is_cap);
    let tone = own * (0.80 + 0.40 * s.id) * depth;
    return written(hair_light(v, n, tone, s), cover, v.clip.xy);
}

@fragment
fn fs_hair_shadow(v: ShadowOut) {
    if strand_or_cap(v.uv, v.bind, 0.02).cover < 0.4 {
        discard;
    }
}
