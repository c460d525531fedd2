// Hair on cards: u selects one of 16 strips of the atlas of strands, v runs from root to tip. The
// normal is that of the head as one hull, the same on both sides of a card. Alpha is the root of
// the share of light that passes through the hair around a point.

// 1: alpha to coverage; 0: alpha test at a threshold.
override COVERAGE: u32 = 1u;


// Sharp coverage at every distance (Golus 2017, "Anti-aliased alpha test").
fn cut(cover: f32, slope: f32) -> f32 {
    if COVERAGE == 1u {
        return saturate1((cover - 0.42) / max(slope, 0.6) + 0.5);
    }
    return select(0.0, 1.0, cover > 0.42);
}

struct Strand {
    cover: f32,   // 0..1
    depth: f32,   // 0 deep in its bundle, 1 on top
    id: f32,      // 0..1, one number per strand
};

// Range over which strands leave the scalp one after another, mm.
const ROOT_MM = 4.0;

fn strand(v: VertexOut, view: vec3<f32>) -> Strand {
    let p = textureSample(strand_map, strand_sampler, v.uv);
    let px = dpdx(v.world);
    let py = dpdy(v.world);
    // A card seen edge-on would look like a wire: it fades in favour of cards that face the viewer.
    let flat = normalize(cross(px, py));
    // The fade does not apply where the whole head turns away.
    let round = max(abs(dot(normalize(v.normal), view)), 0.12);
    let faces = mix(smoothstep(0.12, 0.55, abs(dot(flat, view)) / round), 1.0, 0.12);
    // The growth rate of v along the card gives the distance to the root.
    let t = normalize(v.along + vec3<f32>(0.0, 1e-5, 0.0));
    let s = vec2<f32>(dot(px, t), dot(py, t));
    let rate = max(dot(vec2<f32>(dpdx(v.uv.y), dpdy(v.uv.y)), s) / max(dot(s, s), 1e-12), 1.0);
    let mm = min(1000.0 * v.uv.y / rate, 60.0);
    let root = smoothstep(p.b * ROOT_MM, p.b * ROOT_MM + 1.0 + 0.25 * ROOT_MM, mm + 0.6);
    return Strand(p.r * root * faces, p.g, p.b);
}

// Two highlights of a strand along t. The first is from the near surface. The second is tinted,
// shifted to the tip and from the far side (Marschner et al. 2003, doi:10.1145/882262.882345; as
// simplified by Scheuermann 2004).
fn hair_lobes(t: vec3<f32>, half_way: vec3<f32>, tint: vec3<f32>, id: f32) -> vec3<f32> {
    let th = dot(t, half_way);
    let shift = 0.30 * (id - 0.5);
    let surface = th - 0.055 + shift;
    let inside = th + 0.11 + 1.3 * shift;
    return vec3<f32>(0.065 * exp(-190.0 * surface * surface) * (0.45 + 2.2 * id * id))
        + tint * (0.26 * exp(-34.0 * inside * inside) * (0.55 + 0.9 * id));
}

// Weights of ambient light, of light through the hair and of highlights. Chosen by eye.
const HAIR_AMBIENT = 1.5;
const HAIR_THROUGH = 1.35;
const HAIR_SHINE = 1.3;
// Light from the direction of the hull's normal, relative to the mean over all directions;
// regressed on a bob.
const HAIR_FACING = 1.85;

// Share of a light from l that passes through the hair around a point.
fn hair_through(open: f32, n: vec3<f32>, l: vec3<f32>) -> f32 {
    return saturate1(open * (1.0 + HAIR_FACING * dot(n, l)) * HAIR_THROUGH);
}

fn hair_lamp(v: VertexOut, s: Strand, tone: vec3<f32>, tint: vec3<f32>, scatter: f32, t: vec3<f32>, n: vec3<f32>, view: vec3<f32>, l: vec3<f32>) -> vec3<f32> {
    let hard = hair_through(v.color.a * v.color.a, normalize(v.normal), l);
    let through = mix(hard, sqrt(hard), 0.8 * scatter);
    let nl = dot(n, l);
    let tl = dot(t, l);
    let sine = sqrt(max(1.0 - tl * tl, 0.0));
    let diffuse = mix(saturate1((nl + 0.35) / 1.8225), sine * saturate1(0.5 * nl + 0.6), 0.45);
    let shine = hair_lobes(t, normalize(l + view), tint, s.id) * (HAIR_SHINE * saturate1(1.6 * nl + 0.45));
    // Against the light, thin hair glows.
    let behind = saturate1(-dot(view, l));
    let glow = tint * (0.55 * behind * behind * behind * smoothstep(0.15, 0.8, hard) * sine);
    return tone * diffuse * through + shine * (through * hard) + glow;
}

// Albedo of a strand.
fn strand_tone(v: VertexOut, id: f32) -> vec3<f32> {
    let j = id - 0.5;
    let mean = v.color.rgb * material.base.rgb;
    // Strands of pale hair vary less.
    let own = mean * exp(mix(1.05, 0.45, saturate1(2.0 * mean.g)) * j);
    return mix(own, own * vec3<f32>(1.10, 0.97, 0.86), clamp(1.6 * j, -0.6, 0.6));
}

fn hair_light(v: VertexOut, s: Strand, view: vec3<f32>) -> vec3<f32> {
    let hull = normalize(v.normal);
    let t = normalize(v.along + vec3<f32>(0.0, 1e-5, 0.0));
    let n = normalize(hull - t * dot(hull, t));
    let tone = strand_tone(v, s.id);
    // Transmitted light takes the colour of the strands, less than reflected light does.
    let tint = pow(tone, vec3<f32>(0.62));
    let open = v.color.a * v.color.a;
    // Pale hair scatters light into its depth.
    let scatter = clamp(0.18 + 1.6 * dot(tone, vec3<f32>(0.3, 0.6, 0.1)), 0.0, 0.75);
    let depth = mix(mix(0.42, 1.06, smoothstep(0.12, 0.85, s.depth)), 1.0, 0.7 * scatter);
    let root = mix(mix(0.62, 1.0, smoothstep(0.0, 0.22, v.uv.y)), 1.0, 0.8 * scatter);
    // The baked share holds most of the hair's own shadow, so one sample of the shadow map is
    // enough.
    let share = mix(0.75, 1.0, sharp_share(v.world, hull));
    var light = tone * ambient(n) * (mix(open, sqrt(open), scatter) * HAIR_AMBIENT);
    light += frame.key.xyz * share * hair_lamp(v, s, tone, tint, scatter, t, n, view, frame.key_dir.xyz);
    light += frame.fill.xyz * hair_lamp(v, s, tone, tint, scatter, t, n, view, frame.fill_dir.xyz);
    light += frame.rim.xyz * 0.75 * hair_lamp(v, s, tone, tint, scatter, t, n, view, frame.rim_dir.xyz);
    let up = normalize(0.6 * normalize(view - t * dot(view, t)) + 0.7 * n);
    light += ambient(reflect(-view, up)) * (vec3<f32>(0.035) + 0.09 * tint) * open * open;
    return light * depth * root;
}

// The sharp pass: alpha to coverage (Golus 2017, "Anti-aliased alpha test") or an alpha test.
@fragment
fn fs_hair(v: VertexOut) -> @location(0) vec4<f32> {
    let view = to_eye(v.world);
    let s = strand(v, view);
    let slope = fwidth(s.cover);
    var cover = select(0.0, 1.0, s.cover > 0.5);
    if COVERAGE == 1u {
        cover = saturate1((s.cover - 0.5) / max(slope, 0.08) + 0.5);
    }
    if cover * material.base.a < 0.02 {
        discard;
    }
    return written(hair_light(v, s, view), cover * material.base.a, v.clip.xy);
}

// The soft pass: blends the ends and gaps left by the sharp pass.
@fragment
fn fs_hair_soft(v: VertexOut) -> @location(0) vec4<f32> {
    let view = to_eye(v.world);
    let s = strand(v, view);
    if s.cover < 0.03 || s.cover > 0.97 {
        discard;
    }
    let cover = s.cover * material.base.a;
    let lit = written(hair_light(v, s, view), cover, v.clip.xy);
    return vec4<f32>(lit.rgb * cover, cover);
}

@fragment
fn fs_hair_shadow(v: ShadowOut) {
    if textureSample(strand_map, strand_sampler, v.uv).r < 0.4 {
        discard;
    }
}
