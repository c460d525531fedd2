//! Close views of the shipped figures: decoded images, hanging arms, cameras about head and hands.

use raconteur_base::{DQuat, DVec3, Side, ops};
use raconteur_body::face::{FaceControls, Network, NodeState};
use raconteur_body::figure::Image;
use raconteur_body::read::read_figure;
use raconteur_body::skeleton::{Drive, zero_frames};
use raconteur_body::{Bone, Figure, Pose};
use raconteur_render::Headless;
use raconteur_stage::{Camera, Frame, Lighting};
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

pub(crate) use raconteur_tier::FIGURES;

/// A shipped figure.
pub(crate) fn figure(name: &str) -> Figure {
    let path = format!(
        "{}/../../assets/figures/{name}.glb",
        env!("CARGO_MANIFEST_DIR")
    );
    read_figure(name, &std::fs::read(path).expect("a figure")).expect("a figure")
}

fn pixels(image: &Image) -> (u32, u32, Vec<u8>) {
    if image.mime_type == "image/jpeg" {
        let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGBA);
        let mut decoder =
            zune_jpeg::JpegDecoder::new_with_options(ZCursor::new(&image.bytes), options);
        let rgba = decoder.decode().expect("a JPEG");
        let info = decoder.info().expect("its size");
        return (u32::from(info.width), u32::from(info.height), rgba);
    }
    let mut decoder = png::Decoder::new(std::io::Cursor::new(&image.bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().expect("a PNG");
    let mut samples = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut samples).expect("pixels");
    let n = info.color_type.samples();
    let rgba = samples[..info.buffer_size()]
        .chunks_exact(n)
        .flat_map(|p| match n {
            1 => [p[0], p[0], p[0], 255],
            2 => [p[0], p[0], p[0], p[1]],
            3 => [p[0], p[1], p[2], 255],
            _ => [p[0], p[1], p[2], p[3]],
        })
        .collect();
    (info.width, info.height, rgba)
}

/// Uploads a figure with its images to a device.
pub(crate) fn send(device: &mut Headless, figure: &Figure) {
    device.set_figure(figure).expect("a sound figure");
    for (index, image) in figure.images.iter().enumerate() {
        let (width, height, rgba) = pixels(image);
        device
            .set_image(index, width, height, &rgba)
            .expect("a picture");
    }
}

/// The subject of a shot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum At {
    /// Nose and mouth.
    Nose,
    /// Both eyes.
    Eyes,
    /// The jaw and the throat below it.
    Jaw,
    /// The left ear.
    Ear,
    /// The left hand's nails.
    Nails,
}

/// Returns a standing pose with the arms down and the mouth open.
fn standing() -> Pose {
    let mut pose = Pose::zero();
    pose.set(Bone::Chin, DQuat::from_rotation_z(OPEN_RAD));
    for side in Side::BOTH {
        let shoulder = Bone::on(side, "shoulder");
        let zero = zero_frames()[shoulder.index()];
        let down = DQuat::from_rotation_z(-1.25 * side.sign());
        pose.set(shoulder, zero.inverse() * down * zero);
    }
    pose
}

/// Opening of the mouth, radians, as in mid-word: the shadow of the jaw is best visible below it.
const OPEN_RAD: f64 = 0.12;

/// A face at rest but for its open mouth.
fn speaking() -> FaceControls {
    let mut controls = FaceControls::default();
    controls.jaw.pitch_rad = OPEN_RAD;
    controls
}

/// Returns the nodes of a face with given controls.
pub(crate) fn nodes(figure: &Figure, controls: &FaceControls) -> Vec<NodeState> {
    let Some(tissue) = &figure.tissue else {
        return Vec::new();
    };
    let mut network = Network::new(tissue);
    network.settle(tissue, controls);
    let mut nodes = vec![NodeState::default(); tissue.rest.len()];
    network.write(tissue, 1.0, &mut nodes);
    nodes
}

/// Returns a frame of a standing figure, seen from `yaw` and `pitch` (radians: to its left, from
/// above) about the subject.
pub(crate) fn frame(figure: &Figure, light: Lighting, at: At, yaw: f64, pitch: f64) -> Frame {
    let joints = figure.skeleton.joints();
    let mut frame = Frame::with_capacity(joints.len(), figure.morph_names.len());
    figure
        .skeleton
        .solve(&standing(), &mut frame.world_from_joint);
    frame.lighting = light;
    frame.tissue = nodes(figure, &speaking());
    let eye = |side| {
        let i = joints.iter().position(|j| j.drive == Drive::Eye(side));
        frame.world_from_joint[i.expect("an eye")].translation
    };
    let (l, r) = (eye(Side::Left), eye(Side::Right));
    let (middle, d) = (l.midpoint(r), l.distance(r));
    let bone = |b: Bone| frame.world_from_joint[b.index()].translation;
    let off = |x: f64, y: f64, z: f64| middle + DVec3::new(x, y, z) * d;
    let (target, half) = match at {
        At::Nose => (off(0.0, -0.75, 0.3), 0.75 * d),
        At::Eyes => (off(0.0, 0.0, 0.3), 0.9 * d),
        At::Jaw => (off(0.0, -1.9, -0.4), 1.1 * d),
        At::Ear => (off(1.15, -0.35, -1.25), 0.75 * d),
        At::Nails => (
            bone(Bone::LIndex2).lerp(bone(Bone::LRing2), 0.5) - DVec3::Y * 0.012,
            0.040,
        ),
    };
    let fov = 0.30;
    let (flat, up) = (ops::cos(pitch), ops::sin(pitch));
    let towards = DVec3::new(ops::sin(yaw) * flat, up, ops::cos(yaw) * flat);
    let distance = half / ops::tan(0.5 * fov);
    frame.camera = Camera {
        eye_in_world: target + towards * distance,
        target_in_world: target,
        fov_y_rad: fov,
        near_m: 0.2 * distance,
        ..Camera::default()
    };
    frame
}
