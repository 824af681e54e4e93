//! `studio`: the live page, served to this machine alone.

use super::exit::{Exit, Failure};
use super::origin::{FileKind, WRITTEN_BY};
use super::output::{self, Outputs};
use super::{Context, Run, Without};
use crate::design::{Design, MOST_TABLE};
use crate::follow::Follow;
use crate::scenario::Settings;
use crate::studio::{Engine, Searching, page};
use clap::Args;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
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
    engine: Engine,
    text: String,
    file: String,
    folder: PathBuf,
    save_as: String,
    token: String,
    port: u16,
    searching: Mutex<Option<Searching>>,
    /// What a page asked last, by page and kind of question.
    asked: Mutex<HashMap<String, Follow>>,
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
        let studio = Studio {
            context,
            engine: Engine::new(&name, folder.clone()),
            text,
            file: name,
            folder,
            save_as: format!("{stem}-studio.toml"),
            token: token()?,
            port,
            searching: Mutex::default(),
            asked: Mutex::default(),
        };
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
        if let Some(search) = &*studio.searching.lock().unwrap_or_else(PoisonError::into_inner) {
            search.stop();
        }
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
        Self::json(status, &json!({ "message": message, "problems": null }))
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
            let _ = request.respond(response);
        }
        // What the others still compute ends too.
        self.asked.lock().unwrap_or_else(PoisonError::into_inner).values().for_each(|f| {
            f.stop();
        });
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
            "open" => Ok(json!({ "text": self.text, "file": self.file, "save_as": self.save_as })),
            "save" => self.save(question),
            "optimise" => self.optimise(question),
            "progress" => Ok(self.progress()),
            "stop" => {
                self.searching().iter().for_each(Searching::stop);
                Ok(Value::Null)
            }
            _ => {
                let settings = Settings { follow: self.newest(ask, question), ..Settings::default() };
                self.engine.ask(ask, question, &settings)
            }
        };
        match answer {
            Ok(value) => Reply::json(200, &value),
            Err(refused) => Reply::json(422, &refused),
        }
    }

    /// Stops the question of this kind that the same page asked before, and can be stopped by the next.
    fn newest(&self, ask: &str, question: &Value) -> Follow {
        /// Pages that are remembered; one that has been closed asks nothing more.
        const MOST: usize = 1000;
        let page = question.get("page").and_then(Value::as_str).unwrap_or("");
        let mine = Follow::new();
        let mut asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        if asked.len() > MOST {
            asked.clear();
        }
        if let Some(before) = asked.insert(format!("{page} {ask}"), mine.clone()) {
            before.stop();
        }
        mine
    }

    fn searching(&self) -> std::sync::MutexGuard<'_, Option<Searching>> {
        self.searching.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn optimise(&self, question: &Value) -> Result<Value, Value> {
        let mut searching = self.searching();
        if searching.as_ref().is_some_and(|s| s.progress().running) {
            return Err(refusal("a search is running already, from this page or another; stop it first"));
        }
        let design = self.parsed(question)?;
        *searching = Some(Searching::begin(design));
        Ok(Value::Null)
    }

    fn progress(&self) -> Value {
        match &*self.searching() {
            Some(search) => {
                let p = search.progress();
                json!({ "running": p.running, "said": p.said, "text": p.text })
            }
            None => json!({ "running": false, "said": "no search was begun", "text": null }),
        }
    }

    fn parsed(&self, question: &Value) -> Result<Design, Value> {
        let text = question
            .get("text")
            .and_then(Value::as_str)
            .ok_or_else(|| refusal("the question has no text"))?;
        Design::parse_in(&self.folder, text, &self.file)
            .map_err(|e| json!({ "message": e.to_string(), "problems": e.to_json() }))
    }

    /// Write the design beside the file that is open; only what is a design, only under a plain name.
    fn save(&self, question: &Value) -> Result<Value, Value> {
        let design = self.parsed(question)?;
        let text = |key: &str| question.get(key).and_then(Value::as_str).unwrap_or("").trim();
        let name = Path::new(text("name"));
        if name.file_name().is_none_or(|own| own != name.as_os_str()) {
            return Err(refusal(
                "give a plain file name; it is written into the folder of the file that is open",
            ));
        }
        if name.extension().is_none_or(|e| e != "toml") {
            return Err(refusal("let the name end in .toml: a design file is written there"));
        }
        let path = self.folder.join(name);
        // Whoever wrote it: it may have been edited since.
        if path.exists() && text("replace") != "yes" {
            return Err(refusal(&format!(
                "{} exists; tick the box to replace it, or give another name",
                path.display()
            )));
        }
        let outputs = Outputs::new(None, None, text("replace") == "yes");
        let first = design.source.lines().next().unwrap_or("");
        let ours = if first.starts_with(WRITTEN_BY) {
            design.source.clone()
        } else {
            format!(
                "{WRITTEN_BY} {} studio from {}.\n{}",
                output::VERSION,
                output::path_text(Path::new(&self.file)),
                design.source
            )
        };
        match outputs.write(&path, FileKind::Design, ours.as_bytes()) {
            true => Ok(json!({ "path": path.display().to_string() })),
            false => Err(refusal(&outputs.unwritten().join("; "))),
        }
    }
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
