//! Writes the corpus of the `figure` target: small avatars in every dialect, made by the code of
//! the importer's tests. The argument is the output folder.

#[allow(dead_code, reason = "the importer's tests use the rest")]
#[path = "../../crate/avatar/tests/avatars/made.rs"]
mod made;

use made::{Avatar, Dialect, make};
use raconteur_body::annotation::Annotations;
use raconteur_body::write::to_packed_glb;

fn main() -> std::io::Result<()> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let folder = std::path::Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    for dialect in [
        Dialect::Vrm0,
        Dialect::Vrm1,
        Dialect::Mixamo,
        Dialect::ReadyPlayerMe,
        Dialect::Blender,
    ] {
        for fingers in [false, true] {
            let avatar = Avatar {
                fingers,
                morphs: vec!["jawOpen", "eyeBlinkLeft"],
                ..Avatar::new(dialect)
            };
            let file = make(&avatar);
            let name = format!("{dialect:?}-{fingers}");
            std::fs::write(folder.join(format!("{name}.glb")), file.glb())?;
            std::fs::write(folder.join(format!("{name}.gltf")), file.gltf())?;
            if let Ok((own, _)) = raconteur_avatar::convert("seed", &file.glb()) {
                std::fs::write(folder.join(format!("{name}-own.glb")), own)?;
            }
            if let Ok(imported) = raconteur_avatar::open_figure("seed", &file.glb()) {
                let packed = to_packed_glb(&imported.figure, &Annotations::default());
                std::fs::write(folder.join(format!("{name}-packed.glb")), packed)?;
            }
        }
    }
    Ok(())
}
