//! `studio`: the live page, served to this machine alone.

use super::exit::{Exit, Failure};
use super::origin::FileKind;
use super::output::{self, Outputs};
use super::{Context, Run, Without};
use crate::file::MOST_TABLE;
use crate::studio::{Session, ToSave, page};
use clap::Args;
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::path::PathBuf;
use std::time::Duration;
use tiny_http::{Header, Method, Request, Response, Server};

const EXAMPLES: &str = "\
Examples:
  sprag-design studio my-clutch.toml
  sprag-design studio
  sprag-design studio my-clutch.toml --no-open --port 8017

Every number of the design has a slider and a field. A change is answered at once: margins, sprag, curves; then the scenes.
Pin keeps a design as the dashed one in every picture. Save writes another design file beside FILE; FILE is not touched unless
you name it and allow it. Nothing leaves this machine: the page is served on 127.0.0.1, under an address that nobody can guess,
and fetches nothing. Ctrl-C ends it.";

/// Arguments of `studio`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct StudioArgs {
    /// Design file (TOML) to begin with [default: the clutch of Huang, Liu, Zhao (2017) with law elastic]
    #[arg(value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Do not open the browser, only print the address
    #[arg(long)]
    pub no_open: bool,
    /// Port [default: one that is free]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
}

const FIRST: &str = include_str!("../../designs/huang2017-elastic.toml");
/// Requests answered side by side: a slow scene does not hold a slider up.
const WORKERS: usize = 4;
/// Longest question, bytes: two designs and something.
const LONGEST: u64 = 2 * MOST_TABLE;

struct Studio<'a> {
    context: &'a Context,
    session: Session,
    folder: PathBuf,
    token: String,
    port: u16,
}

impl Run for StudioArgs {
    const WITHOUT: Without = ("its answers are shown in the browser", &["json", "csv", "report", "force"]);

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let (text, file) = match &self.file {
            Some(path) => {
                let design = context.design(path)?;
                (design.source, path.clone())
            }
            None => (FIRST.to_owned(), PathBuf::from("huang2017-elastic.toml")),
        };
        let server = Server::http(("127.0.0.1", self.port)).map_err(|why| {
            let hint =
                if self.port == 0 { "" } else { "; take another --port, or none for one that is free" };
            Failure::Failed(format!("cannot listen on 127.0.0.1, port {}: {why}{hint}", self.port))
        })?;
        let port = server.server_addr().to_ip().map_or(self.port, |at| at.port());
        let folder = output::folder_of(&file);
        let name = file.display().to_string();
        let stem = file.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        let session = Session::new(text, &name, folder.clone(), format!("{stem}-studio.toml"));
        let studio = Studio { context, session, folder, token: token()?, port };
        let address = format!("http://127.0.0.1:{port}/{}/", studio.token);
        output::print(&format!("{address}\n"))?;
        context.message("the studio runs until Ctrl-C");
        if !self.no_open && !open(&address) {
            context.message("no browser could be opened; open the address above");
        }
        std::thread::scope(|scope| {
            for _ in 0..WORKERS {
                scope.spawn(|| studio.serve(&server));
            }
        });
        studio.session.stop();
        Ok(Exit::Held)
    }
}

/// 128 random bits of the system, as hex.
fn token() -> Result<String, Failure> {
    let mut bits = [0; 16];
    getrandom::fill(&mut bits)
        .map_err(|why| Failure::Failed(format!("no random numbers from the system: {why}")))?;
    Ok(bits.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Open the address in the browser.
fn open(address: &str) -> bool {
    let mut command = match std::env::consts::OS {
        "macos" => std::process::Command::new("open"),
        "windows" => {
            let mut command = std::process::Command::new("cmd");
            command.args(["/C", "start", ""]);
            command
        }
        _ => std::process::Command::new("xdg-open"),
    };
    let quiet = || std::process::Stdio::null();
    command.arg(address).stdin(quiet()).stdout(quiet()).stderr(quiet()).spawn().is_ok()
}

/// An answer: HTTP status, kind of text, text.
struct Reply(u16, &'static str, String);

impl Reply {
    fn json(status: u16, value: &Value) -> Self {
        Self(status, "application/json", value.to_string())
    }

    fn refused(status: u16, message: &str) -> Self {
        Self::json(status, &refusal(message))
    }
}

impl Studio<'_> {
    /// Answer requests until Ctrl-C.
    fn serve(&self, server: &Server) {
        while !self.context.follow.stopped() {
            let Ok(Some(mut request)) = server.recv_timeout(Duration::from_millis(200)) else { continue };
            let Reply(status, kind, text) = self.answer(&mut request);
            let header = |name: &str, value: &str| Header::from_bytes(name.as_bytes(), value.as_bytes()).ok();
            let headers = [
                ("Content-Type", &*format!("{kind}; charset=utf-8")),
                ("Cache-Control", "no-store"),
                // Nothing is fetched, nobody may frame the page.
                (
                    "Content-Security-Policy",
                    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'; \
                     frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
                ),
                ("X-Content-Type-Options", "nosniff"),
                ("Referrer-Policy", "no-referrer"),
            ];
            let mut response = Response::from_string(text).with_status_code(status);
            headers
                .iter()
                .filter_map(|(name, value)| header(name, value))
                .for_each(|h| response.add_header(h));
            // A page that has gone does not wait for its answer.
            let _ = in_one_piece(request, response);
        }
        // What the others still compute ends too.
        self.session.stop();
    }

    fn answer(&self, request: &mut Request) -> Reply {
        if !self.is_from_here(request) {
            return Reply::refused(403, "this studio answers its own page alone");
        }
        let Some(path) = request.url().strip_prefix(&format!("/{}/", self.token)).map(str::to_owned) else {
            return Reply::refused(
                403,
                "the address lacks the studio's token; take the address that it printed",
            );
        };
        match (request.method(), path.strip_prefix("ask/")) {
            (Method::Get, None) if path.is_empty() => Reply(200, "text/html", page()),
            (Method::Post, Some(ask)) => match question(request) {
                Ok(question) => self.ask(ask, &question),
                Err(why) => Reply::refused(400, &why),
            },
            _ => Reply::refused(404, "there is no such place in the studio"),
        }
    }

    /// Whether the request names this machine as its host, and comes from this page where it says from where: a name of
    /// somebody else that leads to 127.0.0.1, and another page, are refused.
    fn is_from_here(&self, request: &Request) -> bool {
        let value = |name: &'static str| {
            request.headers().iter().find(|h| h.field.equiv(name)).map(|h| h.value.as_str().to_owned())
        };
        let own = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let host = value("Host").is_some_and(|host| own.contains(&host));
        let origin = value("Origin").is_none_or(|from| own.iter().any(|o| from == format!("http://{o}")));
        host && origin
    }

    fn ask(&self, ask: &str, question: &Value) -> Reply {
        let answer = match ask {
            "save" => self.session.to_save(question).and_then(|saved| self.save(&saved)),
            _ => self.session.ask(ask, question),
        };
        answer.map_or_else(|refused| Reply::json(422, &refused), |value| Reply::json(200, &value))
    }

    /// Write a design beside the file that is open.
    fn save(&self, saved: &ToSave) -> Result<Value, Value> {
        let path = self.folder.join(&saved.name);
        // Whoever wrote it: it may have been edited since.
        if path.exists() && !saved.replace {
            return Err(refusal(&format!(
                "{} exists; tick the box to replace it, or give another name",
                path.display()
            )));
        }
        let outputs = Outputs::new(None, None, saved.replace);
        match outputs.write(&path, FileKind::Design, saved.text.as_bytes()) {
            true => Ok(json!({ "path": path.display().to_string() })),
            false => Err(refusal(&outputs.unwritten().join("; "))),
        }
    }
}

/// Answer in one write: of many, the last would wait some 40 ms for the browser's receipt of those before it.
fn in_one_piece(request: Request, response: Response<impl Read>) -> std::io::Result<()> {
    let mut whole = Vec::new();
    let no_body = *request.method() == Method::Head;
    let version = request.http_version().clone();
    response.with_chunked_threshold(usize::MAX).raw_print(
        &mut whole,
        version,
        request.headers(),
        no_body,
        None,
    )?;
    let mut writer = request.into_writer();
    writer.write_all(&whole)?;
    writer.flush()
}

fn refusal(message: &str) -> Value {
    json!({ "message": message, "problems": null })
}

/// The object that a request holds.
fn question(request: &mut Request) -> Result<Value, String> {
    let mut text = String::new();
    let mut body = request.as_reader().take(LONGEST + 1);
    body.read_to_string(&mut text).map_err(|why| format!("the question cannot be read: {why}"))?;
    if text.len() as u64 > LONGEST {
        return Err("the question is too long".to_owned());
    }
    serde_json::from_str(&text).map_err(|why| format!("the question is no JSON: {why}"))
}
