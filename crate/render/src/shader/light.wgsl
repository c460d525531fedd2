// Light on a surface: the key's shadow, specular lobes, ambient and the window in eyes.

@group(0) @binding(1) var shadow_map: texture_depth_2d;
@group(0) @binding(2) var shadow_sampler: sampler_comparison;

// Share of the key light that arrives, 0..1, at the pixel `at`.
fn key_share(p: vec3<f32>, n: vec3<f32>, at: vec2<f32>) -> f32 {
    return filtered_share(p, n, at, SHADOW_REACH);
}

fn filtered_share(p: vec3<f32>, n: vec3<f32>, at: vec2<f32>, reach: i32) -> f32 {
    // Surfaces edge-on to the light need the larger offset.
    let slope = 1.0 - saturate1(dot(n, frame.key_dir.xyz));
    let q = frame.shadow_from_world[0] * vec4<f32>(p + n * (frame.shadow.y * (0.4 + slope)), 1.0);
    let uv = vec2<f32>(0.5 + 0.5 * q.x, 0.5 - 0.5 * q.y);
    let inside = all(uv > vec2<f32>(0.002)) && all(uv < vec2<f32>(0.998)) && q.z < 1.0;
    if !inside {
        return 1.0;
    }
    // A shift by part of a tap turns the bands between taps into fine grain.
    let grain = pixel_noise(at);
    let shift = vec2<f32>(grain, fract(grain * 7.31 + 0.37)) * 0.5 - 0.25;
    var sum = 0.0;
    var total = 0.0;
    for (var y = -reach; y <= reach; y++) {
        let across = reach - abs(y);
        for (var x = -across; x <= across; x++) {
            let o = vec2<f32>(f32(x), f32(y)) + shift;
            let w = 1.0 / (1.0 + 0.4 * dot(o, o));
            sum += w * textureSampleCompareLevel(
                shadow_map, shadow_sampler, (uv + o * frame.shadow.x) * vec2<f32>(1.0 / f32(SHADOWS), 1.0), q.z - frame.shadow.z);
            total += w;
        }
    }
    return sum / total;
}

// GGX with the height-correlated Smith term in Hammon's approximation (GDC 2017),
// times the cosine; without Fresnel.
fn specular(n: vec3<f32>, v: vec3<f32>, l: vec3<f32>, roughness: f32) -> f32 {
    let h = normalize(v + l);
    let ndl = saturate1(dot(n, l));
    let ndv = max(dot(n, v), 0.05);
    let ndh = saturate1(dot(n, h));
    let alpha = roughness * roughness;
    let a2 = alpha * alpha;
    let d = ndh * ndh * (a2 - 1.0) + 1.0;
    let visibility = 0.5 / max(mix(2.0 * ndl * ndv, ndl + ndv, alpha), 1e-4);
    return min(a2 / (PI * d * d) * visibility * ndl, 24.0);
}

fn fresnel(f0: f32, cosine: f32) -> f32 {
    let x = 1.0 - saturate1(cosine);
    let x2 = x * x;
    return f0 + (1.0 - f0) * x2 * x2 * x;
}

// Ambient irradiance over pi from a direction: sky above, floor below, the lit
// backdrop behind.
fn ambient(n: vec3<f32>) -> vec3<f32> {
    let hemisphere = mix(frame.ground.xyz, frame.sky.xyz, 0.5 + 0.5 * n.y);
    let behind = saturate1(-n.z * 0.6 + 0.1);
    return hemisphere + frame.glow.xyz * (1.6 * behind);
}

// What a smooth surface mirrors from a direction: the ambient and a large soft lamp
// at the key.
fn mirrored(r: vec3<f32>) -> vec3<f32> {
    let lamp = smoothstep(0.55, 1.0, dot(r, frame.key_dir.xyz));
    return ambient(r) * 0.8 + frame.key.xyz * (0.5 * lamp * lamp);
}

// Share of a window of two panes, hung in the direction of the key, seen in a mirror
// direction; 0..1.
fn window_share(r: vec3<f32>) -> f32 {
    let l = frame.key_dir.xyz;
    let facing = dot(r, l);
    if facing < 0.2 {
        return 0.0;
    }
    let right = normalize(cross(vec3<f32>(0.0, 1.0, 0.0), l));
    let up = cross(l, right);
    let q = abs(vec2<f32>(dot(r, right), dot(r, up)) / facing);
    let pane = smoothstep(0.34, 0.26, q.x) * smoothstep(0.42, 0.34, q.y);
    return pane * (0.35 + 0.65 * smoothstep(0.02, 0.06, q.x));
}

// Ambient occlusion as a colour: light bounced within the cavity takes the surface's
// colour (polynomial of Jimenez et al. 2016, "Practical real-time strategies for
// accurate indirect occlusion", eq. 10).
fn tinted_occlusion(ao: f32, albedo: vec3<f32>) -> vec3<f32> {
    let a = 2.0404 * albedo - 0.3324;
    let b = -4.7951 * albedo + 0.6417;
    let c = 2.7552 * albedo + 0.6903;
    // Half of the published tint: skin in deep cavities would glow.
    return mix(vec3<f32>(ao), max(vec3<f32>(ao), ((ao * a + b) * ao + c) * ao), 0.6);
}
