//! Real-time performance, open to minds.
//!
//! One thread performs; each connection has its own thread that reads fragments and sends lines.
//! They communicate through bounded channels only: a mind that floods is read more slowly, a mind
//! that does not read misses lines, and the performance blocks on neither.

pub mod framing;
pub mod greeting;
mod heartbeat;
mod mind;
mod pending;
mod tcp;
mod websocket;

use std::io::{self, Read as _};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::mpsc::Receiver;
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result};
use raconteur_player::live::limits;
use raconteur_player::{Event, Player};
use serde::Serialize;
use std::collections::BTreeMap;

use crate::terminal;
use framing::Framer;
use mind::{ConnectionSender, Disconnected, Line, Mind};

/// Interval at which clock and input are polled.
const STEP: Duration = Duration::from_millis(10);
/// Maximum number of fragments of one mind performed per poll, so that all minds get their turn.
const AT_ONCE: usize = 4;

/// Transports by which minds (programs that control the performance) can connect, with token and
/// idle time.
pub(crate) struct Transports {
    /// Address for WebSockets.
    pub(crate) websocket: Option<SocketAddr>,
    /// Address for plain TCP.
    pub(crate) tcp: Option<SocketAddr>,
    /// True if standard input is a mind.
    pub(crate) stdin: bool,
    /// The token that they must send; without one it is generated and printed.
    pub(crate) token: Option<String>,
    /// A mind that is silent for so long is gone.
    pub(crate) idle: Duration,
}

/// Source of story time in a live performance: real time, or given by the input.
#[derive(Clone, Copy)]
pub(crate) enum Clock {
    /// Real time, this much faster.
    Real {
        /// Story seconds a second.
        speed: f64,
    },
    /// Lines `@SECONDS` of standard input: for scripts with reproducible output.
    Virtual,
}

/// The first message to a mind.
#[derive(Serialize)]
#[serde(tag = "kind", rename = "hello", rename_all = "camelCase")]
struct Greeting<'a> {
    version: u32,
    time_secs: f64,
    /// End of the script, story time, seconds.
    end_secs: f64,
    figure: &'a str,
    /// Named marks of the script, story time, seconds.
    marks: BTreeMap<&'a str, f64>,
}

/// Performs until standard input ends if it is the only transport; otherwise forever.
pub(crate) fn run(mut player: Player, ways: &Transports, clock: Clock) -> Result<()> {
    let token = ways.token.clone().map_or_else(token, Ok)?;
    let open_to_others = ways.websocket.is_some_and(|at| !at.ip().is_loopback());
    let guarded = ways.token.is_some() || open_to_others;
    let (door, arrivals) = ConnectionSender::new(&token, guarded, ways.idle);
    if let Some(address) = ways.websocket {
        let at = listen(address, &door, |stream, door| {
            // A connection that breaks is the mind's affair.
            let _ = websocket::serve(stream, door);
        })?;
        terminal::report(format_args!("raconteur: WebSocket at ws://{at}/"));
        if open_to_others && ways.token.is_none() {
            terminal::report(format_args!(
                "raconteur: it takes those who add ?token={token}"
            ));
        }
    }
    if let Some(address) = ways.tcp {
        let at = listen(address, &door, |stream, door| {
            let _ = tcp::serve(stream, door);
        })?;
        terminal::report(format_args!("raconteur: TCP at {at}"));
        terminal::report(format_args!(
            "raconteur: its first line is: {}",
            greeting::line(&token)
        ));
    }
    if ways.stdin {
        read_input(&door);
    }
    player.set_open_ended(true);
    let mut stage = LiveSession {
        player,
        arrivals,
        minds: Vec::new(),
        minds_begun: 0,
    };
    match clock {
        Clock::Virtual => stage.by_input(),
        Clock::Real { speed } => {
            let alone = ways.websocket.is_none() && ways.tcp.is_none();
            stage.in_real_time(speed, alone)
        }
    }
}

/// Returns a random token with 128 bits.
fn token() -> Result<String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).context("no random numbers for a token; name one with --token")?;
    Ok(bytes.iter().map(|b| format!("{b:02x}")).collect())
}

/// Accepts connections on separate threads; returns the address with the chosen port.
fn listen(
    address: SocketAddr,
    door: &ConnectionSender,
    serve: impl Fn(TcpStream, &ConnectionSender) + Copy + Send + 'static,
) -> Result<SocketAddr> {
    let listener =
        TcpListener::bind(address).with_context(|| format!("cannot listen at {address}"))?;
    let at = listener.local_addr()?;
    let door = door.clone();
    thread::spawn(move || {
        for stream in listener.incoming() {
            let Ok(stream) = stream else {
                // No handles left: the next one may have more luck.
                thread::sleep(STEP);
                continue;
            };
            let door = door.clone();
            let thread = thread::Builder::new().spawn(move || serve(stream, &door));
            if thread.is_err() {
                thread::sleep(STEP);
            }
        }
    });
    Ok(at)
}

/// Reads the standard input in a thread, as slowly as it is performed.
fn read_input(door: &ConnectionSender) {
    let Ok(inbox) = door.enter_by_input() else {
        return;
    };
    thread::spawn(move || {
        let mut framer = Framer::new(limits::FRAGMENT_BYTES);
        let mut bytes = [0; 4096];
        let mut input = io::stdin().lock();
        loop {
            let read = match input.read(&mut bytes) {
                Ok(0) => break,
                Ok(n) => n,
                Err(e) if tcp::would_block(&e) => continue,
                Err(_) => break,
            };
            for fragment in framer.push(&bytes[..read]) {
                if inbox.send(fragment).is_err() {
                    return;
                }
            }
        }
        if let Some(last) = framer.finish() {
            // The page that would have performed it has left.
            let _ = inbox.send(last);
        }
    });
}

/// Live performance and its participants.
struct LiveSession {
    player: Player,
    arrivals: Receiver<Mind>,
    minds: Vec<Mind>,
    minds_begun: u32,
}

impl LiveSession {
    fn in_real_time(&mut self, speed: f64, alone: bool) -> Result<()> {
        let since = Instant::now();
        loop {
            let now_secs = since.elapsed().as_secs_f64() * speed;
            self.greet(now_secs)?;
            let mut input_ended = false;
            let mut gone = Vec::new();
            for i in 0..self.minds.len() {
                for _ in 0..AT_ONCE {
                    let mind = &self.minds[i];
                    if !self.player.has_room(mind.id, now_secs) {
                        break;
                    }
                    match mind.next() {
                        Ok(Some(fragment)) => self.perform(i, &fragment, now_secs)?,
                        Ok(None) => break,
                        Err(Disconnected) => {
                            // A listener on the standard output may still be present.
                            if mind.is_at_input() {
                                input_ended = true;
                            } else {
                                gone.push(i);
                            }
                            break;
                        }
                    }
                }
            }
            for i in gone.into_iter().rev() {
                self.minds.remove(i);
            }
            self.pass(now_secs)?;
            if input_ended && alone {
                self.player.set_open_ended(false);
                if now_secs >= self.player.end_secs() {
                    return Ok(());
                }
            }
            thread::sleep(STEP);
        }
    }

    /// Performs with virtual time: story time advances with the lines `@SECONDS` of standard input,
    /// and ends with it.
    fn by_input(&mut self) -> Result<()> {
        let mut now_secs = 0.0;
        self.greet(now_secs)?;
        self.pass(now_secs)?;
        loop {
            self.greet(now_secs)?;
            let Some(i) = self.minds.iter().position(Mind::is_at_input) else {
                return Ok(());
            };
            let Ok(fragment) = self.minds[i].next_fragment() else {
                return Ok(());
            };
            match fragment.strip_prefix('@').map(str::parse) {
                Some(Ok(secs)) if secs >= now_secs => {
                    now_secs = secs;
                    self.pass(now_secs)?;
                }
                _ => self.perform(i, &fragment, now_secs)?,
            }
        }
    }

    fn greet(&mut self, now_secs: f64) -> Result<()> {
        while let Ok(mut mind) = self.arrivals.try_recv() {
            self.minds_begun = self.minds_begun.wrapping_add(1);
            mind.id = self.minds_begun;
            let marks = &self.player.timeline().marks;
            mind.send_line(&line(&Greeting {
                version: 1,
                time_secs: now_secs,
                end_secs: self.player.duration_secs(),
                figure: &self.player.figure().name,
                marks: marks
                    .iter()
                    .map(|(name, at)| (name.as_str(), *at))
                    .collect(),
            })?)?;
            self.minds.push(mind);
        }
        Ok(())
    }

    /// Performs a fragment and answers the mind that sent it.
    fn perform(&mut self, mind: usize, fragment: &str, now_secs: f64) -> Result<()> {
        let mind = &mut self.minds[mind];
        let performed = self.player.perform(mind.id, fragment, now_secs);
        for event in performed.events(fragment, now_secs) {
            mind.send_line(&line(&event)?)?;
        }
        Ok(())
    }

    /// Advances the time and reports all events.
    fn pass(&mut self, now_secs: f64) -> Result<()> {
        self.player.advance(now_secs);
        for event in self.player.drain_events() {
            let line = line::<Event>(&event)?;
            for mind in &mut self.minds {
                mind.send_line(&line)?;
            }
        }
        Ok(())
    }
}

fn line<T: Serialize>(value: &T) -> Result<Line> {
    Ok(terminal::json(value)?.into())
}
