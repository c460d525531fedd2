// Vertices of the figure: four joints per vertex, rows of world from bind.

struct Joints {
    rows: array<vec4<f32>, 768>,
};

struct Material {
    base: vec4<f32>,     // linear RGB, alpha
    params: vec4<f32>,   // x: roughness, y: 1 if a cornea mesh carries the reflections of the eye,
                         // z: 1 if the background shows through, w: weave of cloth, or 1 with a normal map
    face: vec4<f32>,     // midpoint between the eyes, bind pose; w: their distance, or 0
};

@group(1) @binding(0) var<uniform> joints: Joints;
@group(1) @binding(1) var<uniform> material: Material;

struct VertexIn {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) color: vec4<f32>,
    @location(4) joint: vec4<u32>,
    @location(5) weight: vec4<f32>,
    @location(6) along: vec4<f32>,
};

// Inputs of the lighting are sampled at the centroid. Interpolated at the pixel's centre, beyond an
// outline, they would belong to no point of the surface and cause bright fragments. Inputs that set
// the size of patterns are not, because their derivatives would jump at every edge.
struct VertexOut {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) @interpolate(perspective, centroid) normal: vec3<f32>,
    @location(2) @interpolate(perspective, centroid) along: vec3<f32>,   // direction of increasing v, world
    @location(3) bind: vec3<f32>,    // position in the bind pose, the domain of the noise
    @location(4) uv: vec2<f32>,
    @location(5) @interpolate(perspective, centroid) color: vec4<f32>,
    @location(6) @interpolate(perspective, centroid) bend: f32,          // root of the curvature, -1..1; 1 is a bead of 4 mm radius
    @location(7) @interpolate(perspective, centroid) complexion: vec4<f32>, // strengths of three kinds of wrinkles, 0..1; blush, -1..1
};

struct Blend {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
};

fn blend(joint: vec4<u32>, weight: vec4<f32>) -> Blend {
    let a = joint * 3u;
    // Quantised weights do not always sum to exactly one.
    let w = weight / max(dot(weight, vec4<f32>(1.0)), 1e-6);
    var m: Blend;
    m.x = joints.rows[a.x] * w.x + joints.rows[a.y] * w.y + joints.rows[a.z] * w.z + joints.rows[a.w] * w.w;
    m.y = joints.rows[a.x + 1u] * w.x + joints.rows[a.y + 1u] * w.y + joints.rows[a.z + 1u] * w.z + joints.rows[a.w + 1u] * w.w;
    m.z = joints.rows[a.x + 2u] * w.x + joints.rows[a.y + 2u] * w.y + joints.rows[a.z + 2u] * w.z + joints.rows[a.w + 2u] * w.w;
    return m;
}

fn place(m: Blend, p: vec4<f32>) -> vec3<f32> {
    return vec3<f32>(dot(m.x, p), dot(m.y, p), dot(m.z, p));
}

// Changes of a vertex by the tissue.
struct TissueIn {
    @location(7) moved: vec4<f32>,   // displacement; w: x of the normal's change
    @location(8) turned: vec2<f32>,  // y and z of the normal's change
    @location(9) complexion: vec4<f32>,
};

// Scales as REACH_M and TURN in tissue.rs.
fn displacement(t: TissueIn) -> vec3<f32> { return t.moved.xyz * 0.125; }
fn turn(t: TissueIn) -> vec3<f32> { return vec3<f32>(t.moved.w, t.turned) * 2.0; }

@vertex
fn vs_figure(v: VertexIn) -> VertexOut {
    return placed(v, v.position, v.normal, vec4<f32>(0.0));
}

@vertex
fn vs_bound(v: VertexIn, t: TissueIn) -> VertexOut {
    let c = t.complexion;
    let blush = (c.w * 255.0 - 128.0) / 127.0;
    return placed(v, v.position + displacement(t), v.normal + turn(t), vec4<f32>(c.xyz, blush));
}

fn placed(v: VertexIn, position: vec3<f32>, normal: vec3<f32>, complexion: vec4<f32>) -> VertexOut {
    let m = blend(v.joint, v.weight);
    var o: VertexOut;
    o.world = place(m, vec4<f32>(position, 1.0));
    o.normal = place(m, vec4<f32>(normal, 0.0));
    o.along = place(m, vec4<f32>(v.along.xyz, 0.0));
    o.bind = v.position;
    o.uv = v.uv;
    o.color = v.color;
    o.bend = v.along.w;
    o.complexion = complexion;
    o.clip = frame.clip_from_world * vec4<f32>(o.world, 1.0);
    return o;
}

struct ShadowOut {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) bind: vec3<f32>,
};

// Light of the shadow map: 0 key, 1 rim.
override LIGHT: u32 = 0u;

@vertex
fn vs_shadow(v: VertexIn) -> ShadowOut {
    return shadowed(v, v.position);
}

@vertex
fn vs_bound_shadow(v: VertexIn, t: TissueIn) -> ShadowOut {
    return shadowed(v, v.position + displacement(t));
}

fn shadowed(v: VertexIn, position: vec3<f32>) -> ShadowOut {
    let m = blend(v.joint, v.weight);
    var o: ShadowOut;
    o.clip = frame.shadow_from_world[LIGHT] * vec4<f32>(place(m, vec4<f32>(position, 1.0)), 1.0);
    o.uv = v.uv;
    o.bind = v.position;
    return o;
}

fn to_eye(world: vec3<f32>) -> vec3<f32> {
    return normalize(frame.eye_in_world.xyz - world);
}

// Normal towards the viewer: cards and open cloth are visible from both sides.
fn facing_normal(normal: vec3<f32>, front: bool) -> vec3<f32> {
    let n = normalize(normal);
    return select(-n, n, front);
}

// Normal of cloth. The inside is lit like the outside. The normal stays unchanged on a triangle
// that a fold turns over while its vertices still face the viewer.
fn cloth_normal(v: VertexOut, front: bool) -> vec3<f32> {
    let n = normalize(v.normal);
    return select(-n, n, front || dot(n, frame.eye_in_world.xyz - v.world) > 0.0);
}

// Tilts a normal against the slope of a height field in space.
fn bumped(n: vec3<f32>, slope: vec3<f32>) -> vec3<f32> {
    return normalize(n - (slope - n * dot(slope, n)));
}
