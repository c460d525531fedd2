//! Engines by name. Some run wherever their [`Machine`] runs them, on this machine and in a page's
//! worker; others only on this machine.

use anyhow::{Context as _, Result, bail, ensure};

use super::{
    Engine, EngineOptions, espeak, espeak_library, festival, flite, kokoro, kokoro_network, mary,
    recording,
};

/// Names of the engines that [`by_name`] accepts.
pub const ENGINES: [&str; 6] = [
    "kokoro",
    "festival",
    "flite",
    "espeak-ng",
    "marytts",
    "recordings",
];

/// Names of the engines that are programs or libraries on this machine, in order of preference.
pub(super) const LOCAL_ENGINES: [&str; 4] = ["kokoro", "festival", "flite", "espeak-ng"];

/// Environment that provides the hosts of engines which run on several platforms.
pub trait Machine {
    /// Runs kokoro.
    fn kokoro(&self) -> impl kokoro::Host + 'static;
    /// Runs flite.
    fn flite(&self) -> impl flite::Host + 'static;
    /// Runs espeak-ng.
    fn espeak(&self) -> impl espeak::Host + 'static;
}

/// Returns the named engine in an environment; `None` if it does not support several.
pub fn hosted(name: &str, machine: &impl Machine) -> Option<Box<dyn Engine>> {
    Some(match name {
        "kokoro" => Box::new(kokoro::Kokoro(machine.kokoro())),
        "flite" => Box::new(flite::Flite(machine.flite())),
        "espeak-ng" => Box::new(espeak::Espeak(machine.espeak())),
        _ => return None,
    })
}

/// The programs and libraries of this machine.
struct Installed;

impl Machine for Installed {
    fn kokoro(&self) -> impl kokoro::Host + 'static {
        kokoro_network::Installed::default()
    }

    fn flite(&self) -> impl flite::Host + 'static {
        flite::Installed
    }

    fn espeak(&self) -> impl espeak::Host + 'static {
        espeak_library::Installed
    }
}

/// Returns the engine with a name on this machine.
///
/// # Errors
/// Returns an error if there is no engine of this name, or if the engine lacks an option.
pub fn by_name(name: &str, options: &EngineOptions) -> Result<Box<dyn Engine>> {
    if let Some(engine) = hosted(name, &Installed) {
        return Ok(engine);
    }
    Ok(match name {
        "festival" => Box::new(festival::Festival),
        "marytts" => {
            ensure!(
                !options.server.is_empty(),
                "the engine marytts needs the address of a server, host:port"
            );
            Box::new(mary::Mary::new(&options.server)?)
        }
        "recordings" => {
            let folder = options.recordings.clone();
            let folder =
                folder.context("the engine recordings needs the folder that they lie in")?;
            Box::new(recording::Recordings::new(folder))
        }
        _ => bail!("no engine {name:?}; there are {}", ENGINES.join(", ")),
    })
}
