//! `raconteur serve`.

use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Result, bail};
use clap::Args;
use raconteur_player::{Options, Player, StoryInput};
use raconteur_stage::Shot;

use crate::serve::{Clock, Transports, run};
use crate::story::{StoryFiles, USUAL_FIGURE, find_figure};
use crate::{Outcome, report};

/// The default address for WebSockets.
const USUAL_PORT: u16 = 7373;

/// The range of `--idle`, seconds.
const MIN_IDLE_SECS: f64 = 1.0;
const MAX_IDLE_SECS: f64 = 86_400.0;

/// Perform fragments sent by minds (programs that control a live performance), and report events as
/// JSON lines.
///
/// A mind sends fragments of EML by WebSocket (one per message), TCP or standard input (each
/// fragment ends with the line that closes it). See docs/live.md.
#[derive(Args)]
pub(crate) struct Serve {
    /// Script, or folder that contains a story.eml, to perform meanwhile; its speech bundle is the
    /// figure's voice. Without one the figure waits, silent.
    story: Option<PathBuf>,
    /// A figure's name, or the path of a .glb file; without it, the story's choice, else sofia.
    #[arg(long)]
    figure: Option<String>,
    /// Port for WebSockets; 0 chooses a free one. The default is 7373 if no transport is given.
    #[arg(long)]
    port: Option<u16>,
    /// Port for plain TCP; 0 chooses a free one.
    #[arg(long)]
    tcp: Option<u16>,
    /// Read fragments from standard input and write lines to standard output.
    #[arg(long)]
    stdin: bool,
    /// Listen at this address. Any but a loopback one opens the door to other machines.
    #[arg(long, default_value = "127.0.0.1")]
    listen: IpAddr,
    /// Token required from minds: the first line by TCP is `raconteur 1 TOKEN`; `?token=` or a
    /// bearer header by WebSocket. Without it one is generated and printed; then WebSockets of this
    /// machine need none.
    #[arg(long)]
    token: Option<String>,
    /// Idle timeout of a mind, seconds. A ping is sent after a third of it.
    #[arg(long, default_value_t = 90.0)]
    idle: f64,
    /// Story seconds a second.
    #[arg(long, default_value_t = 1.0)]
    speed: f64,
    /// Advance story time only by `@SECONDS` lines on standard input.
    #[arg(long, requires = "stdin", conflicts_with = "speed")]
    r#virtual: bool,
}

impl Serve {
    pub(crate) fn run(&self) -> Result<Outcome> {
        if !(self.speed.is_finite() && self.speed > 0.0) {
            bail!("--speed takes a positive number, not {}", self.speed);
        }
        if !(MIN_IDLE_SECS..=MAX_IDLE_SECS).contains(&self.idle) {
            bail!(
                "--idle takes {MIN_IDLE_SECS} to {MAX_IDLE_SECS} seconds, not {}",
                self.idle
            );
        }
        let token = self.token.as_deref();
        if token.is_some_and(|t| t.is_empty() || !t.bytes().all(|b| b.is_ascii_graphic())) {
            bail!("--token takes ASCII letters, digits and signs, without spaces");
        }
        let player = self.player()?;
        let no_way = self.port.is_none() && self.tcp.is_none() && !self.stdin;
        let at = |port| SocketAddr::new(self.listen, port);
        let ways = Transports {
            websocket: self.port.or(no_way.then_some(USUAL_PORT)).map(at),
            tcp: self.tcp.map(at),
            stdin: self.stdin,
            token: self.token.clone(),
            idle: Duration::from_secs_f64(self.idle),
        };
        let clock = if self.r#virtual {
            Clock::Virtual
        } else {
            Clock::Real { speed: self.speed }
        };
        run(player, &ways, clock)?;
        Ok(Outcome::Fine)
    }

    fn player(&self) -> Result<Player> {
        let Some(story) = &self.story else {
            let name = self.figure.as_deref().unwrap_or(USUAL_FIGURE);
            let figure = find_figure(name)?;
            return Ok(Player::load(StoryInput {
                eml: "<eml><body/></eml>",
                bundle: None,
                figure: figure.into(),
                options: Options::default(),
            })
            .player);
        };
        let files = StoryFiles::read(story)?;
        let loaded = files.player(self.figure.as_deref(), Shot::Storyteller)?;
        let name = files.script.display().to_string();
        report::print(&name, &files.text, &loaded.diagnostics)?;
        Ok(loaded.player)
    }
}
