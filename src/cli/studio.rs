//! `flexframe studio`: the page of the studio, served to the browser of this machine.

use std::net::{Ipv4Addr, TcpListener};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

use oxhttp::Server;
use oxhttp::model::{Body, HeaderValue, Method, Request, Response, StatusCode, header};

use super::failure::Failure;
use super::options::Common;
use super::terminal;
use crate::params::files::{Disk, Files};

/// Open the studio in the browser: design, check, fold and drop a frame interactively.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  bash studio/build.sh && flexframe studio\n  flexframe studio --port 0 --no-open\n\nThe page computes in the browser. This program only serves its files, on 127.0.0.1. Ctrl+C ends it."
)]
pub(super) struct Args {
    /// The folder that `bash studio/build.sh` makes.
    #[arg(long, default_value = "studio/dist", value_name = "DIR")]
    pub folder: PathBuf,
    /// Port on 127.0.0.1; 0 selects a free one.
    #[arg(long, default_value_t = 8417, value_name = "N")]
    pub port: u16,
    /// Print the address and do not open a browser.
    #[arg(long)]
    pub no_open: bool,
}

/// What the page may load: itself and its WebAssembly, nothing from elsewhere. The page's head says the same for other hosts.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; \
                      worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Connections that are open at the same time: several browsers with six each.
const CONNECTIONS: usize = 64;

/// Largest file of the page, bytes.
const LARGEST: u64 = 64 << 20;

/// Serves the page until it is ended.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    common.refuse_json("the address of a page until it is ended")?;
    let missing: Vec<&str> = ["index.html", "engine/engine.wasm"].into_iter().filter(|file| !args.folder.join(file).is_file()).collect();
    if !missing.is_empty() {
        let message = format!(
            "{} has no {}: the studio is not built. Build it in flexframe's repository by `bash studio/build.sh` (Rust for wasm32-unknown-unknown \
             and Node are needed; docs/studio.md says how), or name the folder of a built one by --folder",
            args.folder.display(),
            missing.join(" and no ")
        );
        return Err(Failure::Usage { message });
    }
    let machine =
        |error| Failure::Machine { what: format!("cannot listen on port {} of 127.0.0.1 (--port 0 takes a free one)", args.port), error };
    let port = if args.port == 0 { free_port().map_err(machine)? } else { args.port };
    let folder = args.folder.clone();
    // Each connection has a thread: one that a browser keeps open, or reads slowly, keeps no other waiting.
    let server = Server::new(move |request| answer(&folder, request))
        .bind((Ipv4Addr::LOCALHOST, port))
        .with_max_concurrent_connections(CONNECTIONS)
        .spawn()
        .map_err(machine)?;
    let address = format!("http://127.0.0.1:{port}/");
    let opened = !args.no_open && open(&address);
    if !common.quiet {
        terminal::print(&format!("{address}{}\n", if opened { "" } else { " (open it in a browser)" }))?;
    }
    server.join().map_err(machine)?;
    Ok(ExitCode::SUCCESS)
}

/// A port that nobody listens on.
fn free_port() -> std::io::Result<u16> {
    Ok(TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?.local_addr()?.port())
}

/// Opens the browser; false when there is none that can be asked.
fn open(address: &str) -> bool {
    let (program, before): (&str, &[&str]) = match std::env::consts::OS {
        "macos" => ("open", &[]),
        "windows" => ("rundll32", &["url.dll,FileProtocolHandler"]),
        _ => ("xdg-open", &[]),
    };
    let quiet = || Stdio::null();
    Command::new(program).args(before).arg(address).stdin(quiet()).stdout(quiet()).stderr(quiet()).spawn().is_ok()
}

/// Answers a request: with a file of the page, or with the words that there is none.
fn answer(folder: &Path, request: &Request<Body>) -> Response<Body> {
    let read = (request.method() == Method::GET).then(|| file_of(folder, request.uri().path())).flatten();
    let found = read.and_then(|path| Some((media_type(&path), Disk.bytes(&path, LARGEST).ok()?)));
    let is_found = found.is_some();
    let (kind, bytes) = found.unwrap_or(("text/plain", b"not found\n".to_vec()));
    let mut response = Response::new(Body::from(bytes));
    *response.status_mut() = if is_found { StatusCode::OK } else { StatusCode::NOT_FOUND };
    let headers = [
        (header::CONTENT_TYPE, kind),
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::CACHE_CONTROL, "no-cache"),
    ];
    response.headers_mut().extend(headers.map(|(name, value)| (name, HeaderValue::from_static(value))));
    response
}

/// The file that the path of an address means: plain names below the folder, and nothing else.
fn file_of(folder: &Path, of_address: &str) -> Option<PathBuf> {
    let path = of_address.strip_prefix('/')?;
    let path = if path.is_empty() { "index.html" } else { path };
    let plain =
        |step: &str| !step.is_empty() && !step.starts_with('.') && step.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));
    path.split('/').all(plain).then(|| folder.join(path)).filter(|path| path.is_file())
}

fn media_type(path: &Path) -> &'static str {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js" | "mjs") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        Some("webmanifest") => "application/manifest+json",
        Some("json") => "application/json",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn planted_nothing_outside_the_folder_is_handed_out() {
        let outer = tempfile::tempdir().expect("a folder");
        let folder = outer.path().join("dist");
        fs::create_dir_all(folder.join("assets")).expect("is made");
        for (path, text) in [("dist/index.html", "page"), ("dist/assets/a-1.js", "code"), ("secret", "no"), ("dist/.hidden", "no")] {
            fs::write(outer.path().join(path), text).expect("is written");
        }
        let found = |url: &str| file_of(&folder, url).is_some();
        for url in ["/", "/index.html", "/assets/a-1.js"] {
            assert!(found(url), "{url}");
        }
        for url in
            ["/../secret", "/assets/../../secret", "/%2e%2e/secret", "//etc/passwd", "/.hidden", "/assets", "", "secret", "/a\\..\\secret"]
        {
            assert!(!found(url), "{url}");
        }
    }
}
