//! Worn, hidden and alternative parts of a file: clothes on own skeletons, invisible nodes, images
//! for some programs only.

use raconteur_avatar::import_figure;
use raconteur_base::DVec3;
use serde_json::{Value, json};

use crate::made::{Avatar, Dialect, File, make};
use crate::performs::{import, pose, posed};

fn codes(imported: &raconteur_avatar::Imported) -> Vec<&'static str> {
    imported.diagnostics.iter().map(|d| d.code).collect()
}

fn list<'f>(file: &'f mut File, key: &str) -> &'f mut Vec<Value> {
    file.json[key].as_array_mut().expect("a list")
}

/// Returns the avatar with a second copy of its mesh, on a copy of its skeleton with names from
/// `rename` and an armature displaced by `moved`.
fn dressed(avatar: &Avatar, moved: [f64; 3], rename: impl Fn(&str) -> String) -> File {
    let mut file = make(avatar);
    let nodes = file.json["nodes"].as_array().expect("nodes").clone();
    let base = nodes.len();
    for (i, node) in nodes.iter().enumerate() {
        let mut copy = node.clone();
        if let Some(children) = copy["children"].as_array_mut() {
            for child in children {
                *child = json!(child.as_u64().expect("a node") as usize + base);
            }
        }
        copy["name"] = json!(rename(node["name"].as_str().expect("a name")));
        if i == 0 {
            copy["translation"] = json!(moved);
        }
        if i == 1 {
            copy["skin"] = json!(1);
        }
        list(&mut file, "nodes").push(copy);
    }
    let mut skin = file.json["skins"][0].clone();
    for joint in skin["joints"].as_array_mut().expect("joints") {
        *joint = json!(joint.as_u64().expect("a node") as usize + base);
    }
    list(&mut file, "skins").push(skin);
    file.json["scenes"] = json!([{ "nodes": [0, 1, base, base + 1] }]);
    file
}

/// The farthest that the clothes are from the body in a pose, metres.
fn gap(file: &File) -> f64 {
    let figure = import(file).figure;
    let [body, clothes] = [0, 1].map(|mesh| posed(&figure, mesh, &pose()));
    let off = body.iter().zip(&clothes).map(|(a, b)| a.distance(*b));
    off.fold(0.0, f64::max)
}

#[test]
fn clothes_with_bones_of_their_own_move_with_the_body() {
    for dialect in [Dialect::Mixamo, Dialect::ReadyPlayerMe, Dialect::Blender] {
        let renames: [fn(&str) -> String; 4] = [
            str::to_owned,
            |name| format!("{name}.001"),
            |name| format!("{name}_1"),
            |name| name.replace("mixamorig:", "coat:"),
        ];
        for (i, rename) in renames.into_iter().enumerate() {
            for posed_rad in [0.0, 0.3] {
                let avatar = Avatar {
                    posed_rad,
                    arms_down_rad: 0.5,
                    ..Avatar::new(dialect)
                };
                let file = dressed(&avatar, [0.0; 3], rename);
                let gap = gap(&file);
                assert!(gap < 1e-4, "{dialect:?} {i} {posed_rad}: {gap} m");
                let codes = codes(&import(&file));
                assert!(!codes.contains(&"skeleton-apart"), "{codes:?}");
            }
        }
    }
}

#[test]
fn clothes_of_a_vrm_move_with_the_body() {
    let file = dressed(&Avatar::new(Dialect::Vrm1), [0.0; 3], str::to_owned);
    let gap = gap(&file);
    assert!(gap < 1e-4, "{gap} m");
}

#[test]
fn clothes_with_few_bones_do_not_lead_the_body() {
    let mut file = dressed(&Avatar::new(Dialect::Mixamo), [0.0; 3], str::to_owned);
    // A sleeve that comes first in the file: its bones from the lower arm on are only decoration.
    for node in list(&mut file, "nodes").iter_mut().take(50) {
        let name = node["name"].as_str().expect("a name").to_owned();
        if name.contains("Fore") || name.contains("Hand") {
            node["name"] = json!(format!("trim {}", name.len()));
        }
    }
    let imported = import(&file);
    assert!(
        !codes(&imported).contains(&"fingers-missing"),
        "the body has its fingers"
    );
    let body = posed(&imported.figure, 1, &pose());
    let reference = make(&Avatar::new(Dialect::Mixamo));
    let wanted = posed(&import(&reference).figure, 0, &pose());
    let off = body.iter().zip(&wanted).map(|(a, b)| a.distance(*b));
    assert!(
        off.fold(0.0, f64::max) < 1e-4,
        "the vertices of the body keep their positions"
    );
}

#[test]
fn what_stands_elsewhere_or_has_other_names_is_told() {
    let avatar = Avatar::new(Dialect::Mixamo);
    for (moved, rename) in [
        ([2.0, 0.0, 0.0], str::to_owned as fn(&str) -> String),
        ([0.0; 3], |name| format!("cloth {}", name.len())),
    ] {
        let file = dressed(&avatar, moved, rename);
        let codes = codes(&import(&file));
        assert!(codes.contains(&"skeleton-apart"), "{moved:?} {codes:?}");
    }
}

/// Adds a triangle next to the figure, below its own node.
fn with_board(visible: Option<bool>) -> File {
    let mut file = make(&Avatar::new(Dialect::Mixamo));
    let position = file.vectors(&[DVec3::X, DVec3::Y, DVec3::ONE]);
    let mesh =
        json!({ "name": "Board", "primitives": [{ "attributes": { "POSITION": position } }] });
    list(&mut file, "meshes").push(mesh);
    let at = list(&mut file, "nodes").len();
    let mut holder = json!({ "name": "Spare", "children": [at + 1] });
    if let Some(visible) = visible {
        holder["extensions"]["KHR_node_visibility"]["visible"] = json!(visible);
        file.json["extensionsRequired"] = json!(["KHR_node_visibility"]);
    }
    list(&mut file, "nodes").extend([holder, json!({ "name": "Board", "mesh": 1 })]);
    file.json["scenes"] = json!([{ "nodes": [0, 1, at] }]);
    file
}

#[test]
fn what_a_node_hides_is_not_drawn() {
    for (visible, meshes) in [(None, 2), (Some(true), 2), (Some(false), 1)] {
        let mut file = with_board(visible);
        assert_eq!(import(&file).figure.meshes.len(), meshes, "{visible:?}");
        file.json["scenes"] = Value::Null;
        assert_eq!(import(&file).figure.meshes.len(), meshes, "{visible:?}");
    }
}

/// Returns an avatar whose surface uses the first of these images and offers the second by an
/// extension.
fn painted(source: Option<&[u8]>, offered: &[u8]) -> File {
    let mut file = make(&Avatar::new(Dialect::Mixamo));
    let pictures = [source.unwrap_or(offered), offered].map(|bytes| {
        let count = bytes.len();
        file.accessor(bytes, 5121, "SCALAR", count);
        json!({ "bufferView": list(&mut file, "bufferViews").len() - 1 })
    });
    file.json["images"] = json!(pictures);
    let mut texture = json!({ "extensions": { "EXT_texture_webp": { "source": 1 } } });
    if source.is_some() {
        texture["source"] = json!(0);
    }
    file.json["textures"] = json!([texture]);
    file.json["materials"] =
        json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
    file.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    file
}

#[test]
fn a_picture_that_is_read_leaves_nothing_out() {
    let png = b"\x89PNG\r\n\x1a\n rest".as_slice();
    let webp = b"RIFF\0\0\0\0WEBP rest".as_slice();
    for (source, images, told) in [
        (Some(png), 1, false),
        (Some(webp), 0, true),
        (None, 0, true),
    ] {
        let file = painted(source, webp);
        let imported = import_figure("x", &file.glb()).expect("a figure");
        assert_eq!(imported.figure.images.len(), images);
        assert_eq!(codes(&imported).contains(&"picture-left-out"), told);
    }
}
