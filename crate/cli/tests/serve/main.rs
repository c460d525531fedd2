//! `raconteur serve`: minds by standard input, TCP and WebSocket; floods, garbage, tokens.

mod server;

use std::fmt::Write as _;
use std::fs;
use std::io::{ErrorKind, Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use serde_json::Value;
use tungstenite::Message;

use self::server::{LONG, Server, Tcp, closing, command, is, receive, root, websocket};

const LINE: &str = "<voice-text time='0' timeId='v'><div>Hello <emph><tm name='w'/>world!</emph>\
                    </div></voice-text>";

/// The recorded session of docs/live.md: lines after `> ` are input, the others output.
#[test]
fn the_recorded_session_is_what_happens() {
    let path = root().join("docs/live.md");
    let text = fs::read_to_string(&path).expect("docs/live.md");
    let opening = "```text session\n";
    let (before, rest) = text.split_once(opening).expect("a session");
    let (session, after) = rest.split_once("```").expect("the end of the session");
    let told: Vec<&str> = session
        .lines()
        .filter_map(|line| line.strip_prefix('>').map(str::trim_start))
        .collect();
    let run = |lines: &[&str]| -> Vec<String> {
        let mut child = command(&["assets/stories/hello-world", "--stdin", "--virtual"])
            .spawn()
            .expect("the program runs");
        let mut input = child.stdin.take().expect("standard input");
        for line in lines {
            writeln!(input, "{line}").expect("sent");
        }
        drop(input);
        let out = child.wait_with_output().expect("it ends");
        assert!(
            out.status.success(),
            "{}",
            String::from_utf8_lossy(&out.stderr)
        );
        let out = String::from_utf8(out.stdout).expect("UTF-8");
        out.lines().map(str::to_owned).collect()
    };
    let mut now = String::new();
    let mut written = 0;
    for count in 0..=told.len() {
        // The output of a session that ends here arrives before the next line.
        let lines = run(&told[..count]);
        for line in &lines[written..] {
            let _ = writeln!(now, "{line}");
        }
        written = lines.len();
        if let Some(line) = told.get(count) {
            let _ = writeln!(now, "{}", format!("> {line}").trim_end());
        }
    }
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&path, format!("{before}{opening}{now}```{after}")).expect("written");
    } else {
        assert_eq!(session, now, "UPDATE=1 rewrites docs/live.md");
    }
}

#[test]
fn a_mind_by_tcp_is_told_what_it_causes() {
    let story = "assets/stories/hello-world";
    let server = Server::start(&[story, "--tcp", "0", "--speed", "4"], 1);
    let mut mind = server.mind();
    let hello = mind.next().expect("a greeting");
    assert!(
        is(&hello, "hello") && hello["marks"]["t2"].is_number(),
        "the first line is the greeting with its marks"
    );
    // Pretty-printed over lines, then garbage, then another.
    mind.send("<seq time='0'>\n  <event type='door'>&lt;open&gt;</event>\n</seq>\n");
    let accepted = mind.until(|l| is(l, "accepted"));
    assert_eq!(accepted["clauses"][1]["element"], "event");
    let event = mind.until(|l| is(l, "storyevent"));
    assert_eq!(
        (&event["type"], &event["payload"]),
        (&"door".into(), &"<open>".into())
    );
    mind.send("<voice-text time='\n\nrubbish\n");
    for _ in 0..2 {
        let failed = mind.until(|l| is(l, "failed"));
        assert!(
            failed["code"]
                .as_str()
                .is_some_and(|c| c.starts_with("eml::")),
            "{failed}"
        );
    }
    mind.send(&format!("{LINE}\n"));
    let fragment = mind.until(|l| is(l, "accepted"))["fragment"].clone();
    let mine = |l: &Value, kind: &str| is(l, kind) && l["fragment"] == fragment;
    mind.until(|l| mine(l, "clause") && l["phase"] == "start");
    mind.until(|l| mine(l, "word") && l["text"] == "world!");
    mind.until(|l| mine(l, "phone") && l["symbol"] == "er");
    mind.until(|l| mine(l, "clause") && l["phase"] == "end");
}

#[test]
fn minds_share_one_storyteller() {
    let server = Server::start(&["--port", "0", "--tcp", "0", "--speed", "4"], 2);
    let mut first = websocket(&format!("ws://{}/", server.addresses[0]), None).expect("let in");
    let mut second = server.mind();
    assert!(
        is(&receive(&mut first), "hello"),
        "the first mind is greeted"
    );
    assert!(
        second.next().is_some_and(|l| is(&l, "hello")),
        "the second mind is greeted"
    );
    first
        .send(Message::text(
            "<event time='0.5' timeId='mine'>from one</event>",
        ))
        .expect("sent");
    assert!(
        is(&receive(&mut first), "accepted"),
        "the first mind's fragment is accepted"
    );
    let told = second.until(|l| is(l, "storyevent"));
    assert_eq!(told["payload"], "from one");
    // And may use its names.
    second.send("<event time='mine+1'>from two</event>\n");
    assert!(
        is(
            &second.until(|l| is(l, "accepted") || is(l, "failed")),
            "accepted"
        ),
        "the second mind's fragment is accepted"
    );
    let told = std::iter::repeat_with(|| receive(&mut first)).find(|l| l["payload"] == "from two");
    assert!(
        told.is_some(),
        "the first mind receives the event of the second"
    );
    // Too long for a fragment is refused, too long for a message ends the connection.
    let long = |n: usize| {
        Message::text(format!(
            "<voice-text time='0'>{}</voice-text>",
            "a ".repeat(n)
        ))
    };
    first.send(long(10_000)).expect("sent");
    let failed = std::iter::repeat_with(|| receive(&mut first)).find(|l| is(l, "failed"));
    assert_eq!(
        failed.map(|l| l["code"].clone()),
        Some("live::too-large".into())
    );
}

#[test]
fn a_flood_slows_the_mind_that_sends_it() {
    let server = Server::start(&["--tcp", "0"], 1);
    let mut calm = server.mind();
    let mut wild = server.mind();
    wild.stream
        .set_write_timeout(Some(Duration::from_millis(200)))
        .expect("a timeout");
    // The client sends until the server accepts nothing more.
    let flood = "<null time='0'/>\n".repeat(1000);
    let mut sent = 0;
    let since = Instant::now();
    while since.elapsed() < LONG {
        match wild.stream.write(flood.as_bytes()) {
            Ok(n) => sent += n,
            Err(e) if matches!(e.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => break,
            Err(e) => panic!("{e}"),
        }
        assert!(sent < 500_000_000, "it is read without end");
    }
    // Another mind still receives a prompt answer.
    assert!(calm.next().is_some(), "the calm mind receives its answer");
    calm.send("<eml name='calm'><body><event time='0'>hello</event></body></eml>\n");
    let answer = calm.until(|l| is(l, "accepted"));
    assert_eq!(answer["name"], "calm");
    calm.until(|l| l["payload"] == "hello");
    // Nothing is rejected: the flood waits in the connection.
    for _ in 0..50 {
        assert!(
            !is(&wild.next().expect("a line"), "failed"),
            "the flooding mind is slowed and not rejected"
        );
    }
}

#[test]
fn binary_garbage_harms_nobody() {
    let server = Server::start(&["--tcp", "0", "--port", "0"], 2);
    let mut noise = TcpStream::connect(&server.addresses[1]).expect("a connection");
    let bytes: Vec<u8> = (0..200_000_u32)
        .map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8)
        .collect();
    let _ = noise.write_all(&bytes);
    // To the WebSocket, too, where it is no handshake.
    let mut stream = TcpStream::connect(&server.addresses[0]).expect("a connection");
    let _ = stream.write_all(&bytes);
    stream.set_read_timeout(Some(LONG)).expect("a timeout");
    let _ = stream.read(&mut [0; 64]);
    let mut calm = server.mind();
    calm.send("<event time='0'>still here</event>\n");
    calm.until(|l| l["payload"] == "still here");
}

#[test]
fn a_token_keeps_strangers_out() {
    let server = Server::start(&["--port", "0", "--tcp", "0", "--token", "s3cret"], 2);
    let url = format!("ws://{}/", server.addresses[0]);
    assert_eq!(websocket(&url, None).err(), Some(403));
    assert_eq!(
        websocket(&format!("{url}?token=s3cre"), None).err(),
        Some(403)
    );
    assert_eq!(
        websocket(&url, Some(("authorization", "Bearer wrong!"))).err(),
        Some(403)
    );
    assert!(
        websocket(&format!("{url}?x=1&token=s3cret"), None).is_ok(),
        "a token in the query is accepted"
    );
    assert!(
        websocket(&url, Some(("authorization", "Bearer s3cret"))).is_ok(),
        "a token in the header is accepted"
    );
    assert_eq!(server.greeting, "raconteur 1 s3cret\n");
    for wrong in [
        "s3cret\n",
        "<null time='0'/>\n",
        "raconteur 1 s3cre\n",
        "raconteur 1 \n",
    ] {
        let mut stranger = Tcp::connect(&server.addresses[1]);
        stranger.send(wrong);
        let told = stranger.next().map(|l| l["code"].clone());
        assert_eq!(told, Some("serve::token".into()), "{wrong:?}");
        assert!(
            stranger.next().is_none(),
            "a connection without a token is closed"
        );
    }
    let mut friend = server.mind();
    friend.send("<event time='0'>in</event>\n");
    friend.until(|l| l["payload"] == "in");
}

#[test]
fn what_a_page_makes_a_browser_send_is_not_performed() {
    let server = Server::start(&["--tcp", "0"], 1);
    assert_ne!(server.greeting, Server::start(&["--tcp", "0"], 1).greeting);
    // The page controls a form's body, which may contain lines that look like a greeting.
    let body = "raconteur 1 x\n<event time='0'>from a page</event>\n";
    for method in ["POST", "GET", "OPTIONS", "PUT"] {
        let mut page = Tcp::connect(&server.addresses[0]);
        let length = body.len();
        page.send(&format!(
            "{method} / HTTP/1.1\r\nhost: localhost\r\ncontent-type: text/plain\r\n\
             content-length: {length}\r\n\r\n{body}"
        ));
        let mut answer = String::new();
        let read = page.lines.read_to_string(&mut answer);
        assert!(
            read.is_ok() && answer.starts_with("HTTP/1.1 400 "),
            "{answer}"
        );
    }
    let mut friend = server.mind();
    friend.send("<event time='0.2'>mine</event>\n");
    let event = friend.until(|l| is(l, "storyevent"));
    assert_eq!(event["payload"], "mine");
}

/// Strangers keep opening connections and send a byte now and then while minds connect: all minds
/// are served, and no stranger keeps a slot.
#[test]
fn dripping_strangers_keep_nobody_out() {
    let server = Server::start(&["--port", "0", "--tcp", "0"], 2);
    let connect = |address: &String| TcpStream::connect(address).expect("a connection");
    let mut strangers: Vec<TcpStream> = (0..100)
        .flat_map(|_| server.addresses.iter().map(connect))
        .collect();
    let url = format!("ws://{}/", server.addresses[0]);
    for round in 0..4 {
        for (i, stranger) in strangers.iter_mut().enumerate() {
            let greeting: &[u8] = [b"GET /", b"racon"][i % 2];
            // Removed connections do not accept the bytes.
            let _ = stranger.write_all(&greeting[round..=round]);
        }
        strangers.extend(server.addresses.iter().map(connect));
        let mut socket = websocket(&url, None).expect("let in");
        assert!(
            is(&receive(&mut socket), "hello"),
            "the mind with the token is greeted"
        );
        let mut mind = server.mind();
        mind.send("<event time='0'>heard</event>\n");
        mind.until(|l| l["payload"] == "heard");
    }
    for mut stranger in strangers {
        stranger.set_read_timeout(Some(LONG)).expect("a timeout");
        let mut answer = Vec::new();
        match stranger.read_to_end(&mut answer) {
            Ok(_) => {}
            Err(e) => assert_eq!(e.kind(), ErrorKind::ConnectionReset),
        }
    }
}

#[test]
fn a_websocket_is_told_why_it_is_closed() {
    let server = Server::start(&["--port", "0", "--tcp", "0"], 2);
    let url = format!("ws://{}/", server.addresses[0]);
    // Too long for a message.
    let mut long = websocket(&url, None).expect("let in");
    long.send(Message::text("a ".repeat(200_000)))
        .expect("sent");
    assert_eq!(closing(&mut long), Some(1009));
    drop(long);
    // No slots are left for either protocol.
    let mut minds = Vec::new();
    for _ in 0..40 {
        let mut mind = server.mind();
        let hello = mind.next().expect("an answer");
        if is(&hello, "hello") {
            minds.push(mind);
        } else {
            assert_eq!(hello["code"], "serve::full");
        }
    }
    assert_eq!(minds.len(), 32);
    let mut late = websocket(&url, None).expect("let in");
    assert_eq!(closing(&mut late), Some(1013));
    // A disconnected mind frees its slot.
    drop(minds.pop());
    let again = std::iter::repeat_with(|| websocket(&url, None).expect("let in"));
    let mut again = again.map(|mut socket| socket.read());
    let is_hello = |m: &Message| m.to_text().is_ok_and(|t| t.contains("hello"));
    assert!(
        again.any(|m| m.is_ok_and(|m| is_hello(&m))),
        "a connection succeeds after a mind has left"
    );
}

#[test]
fn who_answers_pings_stays() {
    let server = Server::start(&["--port", "0", "--tcp", "0", "--idle", "12"], 2);
    let mut silent = server.mind();
    let mut awake = server.mind();
    let url = format!("ws://{}/", server.addresses[0]);
    // Its library answers pings while it reads.
    let mut socket = websocket(&url, None).expect("let in");
    std::thread::spawn(move || while socket.read().is_ok() {});
    for _ in 0..2 {
        awake.until(|l| is(l, "ping"));
        awake.send("\n");
    }
    let told = silent.until(|l| is(l, "failed"));
    assert_eq!(told["code"], "serve::idle");
    assert!(
        silent.next().is_none(),
        "a connection without a pong is closed"
    );
    awake.send("<event time='0'>awake</event>\n");
    awake.until(|l| l["payload"] == "awake");
}

#[test]
fn pages_of_other_hosts_are_not_let_in_without_a_token() {
    let server = Server::start(&["--port", "0"], 1);
    let url = format!("ws://{}/", server.addresses[0]);
    let from = |origin| websocket(&url, Some(("origin", origin)));
    assert_eq!(from("https://evil.example").err(), Some(403));
    assert_eq!(from("null").err(), Some(403));
    assert!(
        from("http://localhost:4173").is_ok(),
        "a page of localhost is accepted"
    );
}

#[test]
fn the_standard_input_alone_ends_with_what_it_sent() {
    let mut child = command(&["assets/stories/hello-world", "--stdin", "--speed", "50"])
        .spawn()
        .expect("the program runs");
    let mut input = child.stdin.take().expect("standard input");
    input
        .write_all(format!("{LINE}\n").as_bytes())
        .expect("sent");
    drop(input);
    let out = child.wait_with_output().expect("it ends");
    assert!(
        out.status.success(),
        "the server ends with its standard input"
    );
    let out = String::from_utf8(out.stdout).expect("UTF-8");
    let ends = out
        .lines()
        .filter(|l| l.contains("\"end\"") && l.contains("voice-text"));
    assert_eq!(ends.count(), 2, "the story's line and the mind's: {out}");
}

#[test]
fn wrong_usage_is_named() {
    for arguments in [
        &["--speed", "0"][..],
        &["--token", "two words"],
        &["--idle", "0.1"],
        &["no/such/story"],
    ] {
        let out = command(arguments).output().expect("the program runs");
        assert!(
            !out.status.success() && !out.stderr.is_empty(),
            "{arguments:?}"
        );
    }
}
