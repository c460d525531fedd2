//! look NAME OUT.ppm [size] [bust|turn|close|far] [low]
use raconteur_base::{DAffine3, DQuat, DVec3};
use raconteur_body::{Bone, Figure, Pose};
use raconteur_render::{Headless, Quality, RenderOptions};
use raconteur_stage::{Camera, Frame};
fn bind_pose(figure: &Figure) -> Pose {
    let mut pose = Pose::zero();
    let world = |b: Bone| figure.inverse_bind[b.index()].inverse().to_scale_rotation_translation().1;
    for bone in Bone::ALL {
        let local = bone.parent().map_or(world(bone), |p| world(p).inverse() * world(bone));
        let zero = figure.skeleton.joints()[bone.index()].zero_rotation;
        pose.set(bone, zero.inverse() * local);
    }
    pose
}
fn turn(pose: &mut Pose, figure: &Figure, bone: Bone, world: DQuat) {
    let b = figure.inverse_bind[bone.index()].inverse().to_scale_rotation_translation().1;
    pose.set(bone, pose.rotation(bone) * (b.inverse() * world * b));
}
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let size: u32 = a.get(3).map_or(560, |s| s.parse().unwrap());
    let mode = a.get(4).map_or("bust", String::as_str);
    let low = a.get(5).is_some_and(|s| s == "low");
    let figure = if a[1].ends_with(".glb") {
        raconteur_body::read::read_figure("x", &std::fs::read(&a[1]).unwrap()).unwrap()
    } else {
        let (name, style) = a[1].split_once(':').unwrap_or((&a[1], ""));
        #[allow(unused_mut)]
        let mut p = raconteur_body::generator::people::preset(name).expect("name");
        STYLE(&mut p, style);
        raconteur_body::generator::build(&p).figure
    };
    for m in &figure.meshes {
        let k = format!("{:?}", m.material.kind);
        if k == "Hair" || k == "Lash" {
            let mb: usize = m.morphs.iter().map(|x| x.vertices.len() * 9).sum();
            println!("{} {k}: {} verts {} tris {} KB morphs {} KB ({})", m.name, m.positions.len(), m.indices.len() / 3,
                (m.positions.len() * 28 + m.indices.len() * 2) / 1000, mb / 1000, m.morphs.len());
        }
    }
    let quality = if low { Quality::Low } else { Quality::High };
    let mut h = Headless::new_blocking(RenderOptions { quality }).unwrap();
    h.set_figure(&figure).unwrap();
    let mut pose = bind_pose(&figure);
    if mode == "turn" {
        let y = |d: f64| DQuat::from_rotation_y(d.to_radians());
        turn(&mut pose, &figure, Bone::Cervical, y(26.0));
        turn(&mut pose, &figure, Bone::Skull, y(34.0));
    }
    let mut world: Vec<DAffine3> = Vec::new();
    figure.skeleton.solve(&pose, &mut world);
    let mut frame = Frame::with_capacity(world.len(), figure.morph_names.len());
    frame.world_from_joint = world;
    if mode == "smile" {
        for n in ["mouthSmileLeft", "mouthSmileRight", "browInnerUp", "browOuterUpLeft"] {
            if let Some(i) = figure.morph_index(n) { frame.morph_weights[i] = 1.0; }
        }
        let j = Bone::Chin.index();
        let skull = frame.world_from_joint[j];
        frame.world_from_joint[j] = skull * DAffine3::from_rotation_z(0.2);
    }
    let light = frame.lighting;
    let s = figure.skeleton.stature_m();
    let (views, dist, cy): (&[(f64, f64)], f64, f64) = match mode {
        "close" | "smile" => (&[(0.0, 2.0), (-40.0, 2.0)], 1.15, s - 0.115),
        "brow" => (&[(0.0, 0.0), (-35.0, 0.0)], 0.45, s - 0.105),
        "far" => (&[(0.0, 0.0), (-50.0, 5.0), (90.0, 5.0), (180.0, 5.0)], 5.0, s - 0.3),
        "top" => (&[(0.0, 35.0), (-60.0, 35.0), (110.0, 30.0), (180.0, 30.0)], 1.35, s - 0.13),
        _ => (&[(0.0, 3.0), (-42.0, 3.0), (90.0, 3.0), (180.0, 6.0)], 1.45, s - 0.145),
    };
    let cols = 2u32;
    let rows = (views.len() as u32).div_ceil(2);
    let mut out = vec![0u8; (size * cols * size * rows * 3) as usize];
    for (k, (az, el)) in views.iter().enumerate() {
        let (sa, ca) = az.to_radians().sin_cos();
        let (se, ce) = el.to_radians().sin_cos();
        let target = DVec3::new(0.0, cy, 0.01);
        frame.camera = Camera { eye_in_world: target + DVec3::new(sa * ce, se, ca * ce) * dist, target_in_world: target, fov_y_rad: 0.32, ..Camera::default() };
        frame.lighting = light;
        if az.abs() > 60.0 {
            let q = DQuat::from_rotation_y(az.to_radians() * 0.75);
            frame.lighting.key.towards_light_in_world = q * light.key.towards_light_in_world;
            frame.lighting.fill.towards_light_in_world = q * light.fill.towards_light_in_world;
            frame.lighting.rim.towards_light_in_world = q * light.rim.towards_light_in_world;
        }
        let px = h.render_rgba(&frame, size, size).unwrap();
        let (cx, cy) = (k as u32 % 2 * size, k as u32 / 2 * size);
        for y in 0..size { for x in 0..size {
            let i = ((y * size + x) * 4) as usize;
            let o = (((cy + y) * size * cols + cx + x) * 3) as usize;
            out[o..o + 3].copy_from_slice(&px[i..i + 3]);
        } }
    }
    let mut bytes = format!("P6\n{} {}\n255\n", size * cols, size * rows).into_bytes();
    bytes.extend(out);
    std::fs::write(&a[2], bytes).unwrap();
}
#[allow(non_snake_case)]
fn STYLE(p: &mut raconteur_body::generator::people::FigureParams, s: &str) {
    if s.is_empty() { return; }
    p.hair.style = raconteur_body::generator::hair::HairStyle::NAMES.iter().find(|n| n.1 == s).expect("style").0;
}
