//! Serves the page to browsers on this computer.
//!
//! It listens on the loopback interface only. Other users and other pages in the browser can reach that, too: every
//! address has a random token, and a request must name this very computer as its host, so that no foreign name that
//! resolves to it passes (DNS rebinding). A client that reads slowly keeps a thread of its own.

use super::news::News;
use std::error::Error;
use std::io::Cursor;
use std::net::Ipv4Addr;
use std::sync::Arc;
use std::thread::Builder;
use tiny_http::{Header, Method, Request, Response, Server, StatusCode};

/// Bytes of the token.
const TOKEN: usize = 16;

/// Headers of each answer: nothing is kept, guessed, framed or told to others.
const HEADERS: [(&str, &str); 5] = [
    ("Cache-Control", "no-store"),
    ("X-Content-Type-Options", "nosniff"),
    ("Content-Security-Policy", "frame-ancestors 'none'"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
];

const HTML: &str = "text/html; charset=utf-8";
const JSON: &str = "application/json";
const TEXT: &str = "text/plain; charset=utf-8";

/// What is served.
struct Site {
    /// What paths begin with: `/TOKEN/`.
    root: String,
    /// What a request may call this computer.
    hosts: [String; 2],
    page: Arc<[u8]>,
    news: News,
}

/// Status, kind and content of an answer.
type Answer = (u16, &'static str, Arc<[u8]>);

/// Starts to serve the page of the model that is called `title`, and gives its address.
pub fn start(title: &str, news: News) -> Result<String, Box<dyn Error + Send + Sync>> {
    let mut random = [0; TOKEN];
    getrandom::fill(&mut random)?;
    let token: String = random.iter().map(|byte| format!("{byte:02x}")).collect();
    let server = Server::http((Ipv4Addr::LOCALHOST, 0))?;
    let port = server.server_addr().to_ip().ok_or("it has no port")?.port();
    let site = Site {
        root: format!("/{token}/"),
        hosts: ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}")),
        page: ancf14_view::watching(title).into_bytes().into(),
        news,
    };
    let address = format!("http://127.0.0.1:{port}{}", site.root);
    Builder::new().spawn(move || {
        for request in server.incoming_requests() {
            let answer = site.answer_to(&request);
            // Without a thread to write it, the answer is dropped, which tells the client that it failed.
            drop(Builder::new().spawn(move || request.respond(response(answer))));
        }
    })?;
    Ok(address)
}

impl Site {
    fn answer_to(&self, request: &Request) -> Answer {
        let host = request.headers().iter().find(|header| header.field.equiv("Host"));
        self.answer(request.method(), request.url(), host.map(|header| header.value.as_str()))
    }

    fn answer(&self, method: &Method, path: &str, host: Option<&str>) -> Answer {
        let refused = |status: u16, reason: &str| (status, TEXT, reason.as_bytes().into());
        if !host.is_some_and(|host| self.hosts.iter().any(|own| own.eq_ignore_ascii_case(host))) {
            return refused(403, "This page is for browsers on the computer that serves it.");
        }
        let Some(name) = path.strip_prefix(&self.root) else {
            return refused(403, "Open the address that ancf14 view --watch has printed: it is another one each time.");
        };
        if *method != Method::Get {
            return refused(405, "There is nothing here but pages to read.");
        }
        match name {
            "" => (200, HTML, Arc::clone(&self.page)),
            "news" => (200, JSON, self.news.text()),
            "data" => (200, JSON, self.news.data()),
            _ => refused(404, "There is no such page."),
        }
    }
}

fn response((status, kind, content): Answer) -> Response<Cursor<Arc<[u8]>>> {
    let headers = HEADERS.into_iter().chain([("Content-Type", kind)]);
    let headers = headers.filter_map(|(name, value)| Header::from_bytes(name, value).ok()).collect();
    let length = content.len();
    Response::new(StatusCode(status), headers, Cursor::new(content), Some(length), None)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whoever does not know the token, or comes by another name of this computer, gets nothing of the model.
    #[test]
    fn strangers_get_nothing() {
        let site = Site {
            root: "/secret/".to_owned(),
            hosts: ["127.0.0.1:7".to_owned(), "localhost:7".to_owned()],
            page: b"page".to_vec().into(),
            news: News::default(),
        };
        let status = |method: &Method, path: &str, host: Option<&str>| site.answer(method, path, host).0;
        let own = Some("127.0.0.1:7");
        for path in ["/secret/", "/secret/news", "/secret/data"] {
            assert_eq!(status(&Method::Get, path, own), 200);
            assert_eq!(status(&Method::Get, path, Some("LocalHost:7")), 200);
            assert_eq!(status(&Method::Post, path, own), 405);
            for host in [
                None,
                Some(""),
                Some("127.0.0.1"),
                Some("127.0.0.1:8"),
                Some("evil.example:7"),
                Some("127.0.0.1:7.evil.example"),
            ] {
                assert_eq!(status(&Method::Get, path, host), 403, "{host:?}");
            }
        }
        for path in ["", "/", "/secret", "/Secret/", "/other/news", "//secret/", "/x/../secret/", "/favicon.ico"] {
            assert_eq!(status(&Method::Get, path, own), 403, "{path}");
        }
        assert_eq!(status(&Method::Get, "/secret/../etc/passwd", own), 404);
    }
}
