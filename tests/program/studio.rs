//! `flexframe studio` as browsers use it: connections that stay open, several at once.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::sync::Barrier;
use std::time::Duration;

use tempfile::TempDir;

/// Connections at once, which stay open: more than the threads that a pool would begin with.
const CONNECTIONS: usize = 32;

/// What ends a test that hangs; nothing is measured by it.
const PATIENCE: Duration = Duration::from_secs(300);

/// The program, serving a page of two files, and where.
struct Served {
    program: Child,
    address: String,
    _folder: TempDir,
}

impl Served {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir_all(folder.path().join("engine")).expect("is made");
        fs::write(folder.path().join("index.html"), "the page").expect("is written");
        fs::write(folder.path().join("engine/engine.wasm"), [0; 100_000]).expect("is written");
        let mut program = Command::new(env!("CARGO_BIN_EXE_flexframe"));
        program.args(["studio", "--no-open", "--port", "0", "--folder"]).arg(folder.path()).stdout(Stdio::piped());
        let mut program = program.spawn().expect("runs");
        let mut line = String::new();
        BufReader::new(program.stdout.take().expect("is piped")).read_line(&mut line).expect("reads");
        let address = line.split("//").nth(1).and_then(|rest| rest.split('/').next()).expect("an address").to_string();
        Self { program, address, _folder: folder }
    }

    fn connected(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.address).expect("listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("is set");
        stream
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// Asks for a path on a connection, which stays open: head, and length of the body.
fn asked(stream: &mut TcpStream, path: &str) -> (String, usize) {
    stream.write_all(format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n").as_bytes()).expect("is sent");
    let mut head = Vec::new();
    while !head.ends_with(b"\r\n\r\n") {
        let mut byte = [0];
        stream.read_exact(&mut byte).expect("an answer");
        head.push(byte[0]);
    }
    let head = String::from_utf8(head).expect("text").to_lowercase();
    let length = head.split("content-length: ").nth(1).and_then(|rest| rest.lines().next()).expect("a length");
    let mut body = vec![0; length.parse().expect("a number")];
    stream.read_exact(&mut body).expect("a body");
    (head, body.len())
}

#[test]
fn planted_connections_that_stay_open_keep_no_other_waiting() {
    let served = Served::new();
    for _ in 0..4 {
        let (at_once, answered) = (Barrier::new(CONNECTIONS), Barrier::new(CONNECTIONS));
        std::thread::scope(|scope| {
            for _ in 0..CONNECTIONS {
                scope.spawn(|| {
                    at_once.wait();
                    let mut stream = served.connected();
                    let lengths = ["/", "/engine/engine.wasm"].map(|path| asked(&mut stream, path).1);
                    assert_eq!(lengths, [8, 100_000]);
                    // None is closed before all have their answers.
                    answered.wait();
                });
            }
        });
    }
}

#[test]
fn analytic_files_have_their_kind_and_the_policy_and_nothing_else_is_there() {
    let served = Served::new();
    let mut stream = served.connected();
    let (head, _) = asked(&mut stream, "/?x=1");
    assert!(head.starts_with("http/1.1 200"), "{head}");
    for header in
        ["content-type: text/html; charset=utf-8", "content-security-policy: default-src 'none'", "x-content-type-options: nosniff"]
    {
        assert!(head.contains(header), "{head}");
    }
    assert!(asked(&mut stream, "/engine/engine.wasm").0.contains("content-type: application/wasm"));
    for elsewhere in ["/../Cargo.toml", "/engine", "/engine/other.wasm", "/%2e%2e/secret"] {
        assert!(asked(&mut stream, elsewhere).0.starts_with("http/1.1 404"), "{elsewhere}");
    }
}
