//! flexframe as a WebAssembly module: a request goes in as text with files attached, an answer comes out as JSON with files.
//!
//! The page that uses it calls [`request_room`], writes the request there, calls [`ask`], and reads the answer from memory by
//! the four functions below. `../engine.mjs` does that. There is one state a module: the frames that are open, and the parts
//! that were made for them. studio/README.md lists the requests.
//!
//! The interface is these few numbers so that no other program has to be run over the module to make it loadable.

mod answer;
mod beds;
mod catalogue;
mod drops;
mod files;
mod mechanics;
mod open_frame;
mod request;
mod studio;

use std::cell::RefCell;
use std::sync::Once;

use answer::Answer;
use studio::Studio;

/// What the page sees of the module's memory.
#[derive(Default)]
struct Desk {
    request: Vec<u8>,
    text: Vec<u8>,
    bytes: Vec<u8>,
}

thread_local! {
    static STUDIO: RefCell<Studio> = RefCell::new(Studio::default());
    static DESK: RefCell<Desk> = RefCell::new(Desk::default());
    static PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

#[link(wasm_import_module = "studio")]
unsafe extern "C" {
    /// A stage of a long request begins: how many were done before, of how many, and its name in memory.
    safe fn stage(done: usize, of: usize, name: *const u8, length: usize);
}

/// Tells the page of a stage.
fn tell_stage(done: usize, of: usize, name: &str) {
    stage(done, of, name.as_ptr(), name.len());
}

/// Room for a request of so many bytes: its text, then the attached files.
#[unsafe(no_mangle)]
pub extern "C" fn request_room(bytes: usize) -> *mut u8 {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| std::panic::set_hook(Box::new(|panic| PANIC.set(panic.to_string()))));
    DESK.with_borrow_mut(|desk| {
        desk.request = vec![0; bytes];
        desk.request.as_mut_ptr()
    })
}

/// Answers the request, whose text has so many bytes: 0 when it was answered, 1 when it was refused.
#[unsafe(no_mangle)]
pub extern "C" fn ask(text_bytes: usize) -> u32 {
    let request = DESK.with_borrow_mut(|desk| std::mem::take(&mut desk.request));
    let (text, attached) = request.split_at(text_bytes.min(request.len()));
    let answer = STUDIO.with_borrow_mut(|studio| request::read(text, attached).and_then(|request| studio.answer(request)));
    let refused = u32::from(answer.is_err());
    let (text, bytes) = answer.unwrap_or_else(Answer::from).written();
    DESK.with_borrow_mut(|desk| (desk.text, desk.bytes) = (text, bytes));
    refused
}

/// Where the answer's text begins.
#[unsafe(no_mangle)]
pub extern "C" fn text() -> *const u8 {
    DESK.with_borrow(|desk| desk.text.as_ptr())
}

/// How many bytes the answer's text has.
#[unsafe(no_mangle)]
pub extern "C" fn text_length() -> usize {
    DESK.with_borrow(|desk| desk.text.len())
}

/// Where the answer's files begin, one after the other.
#[unsafe(no_mangle)]
pub extern "C" fn bytes() -> *const u8 {
    DESK.with_borrow(|desk| desk.bytes.as_ptr())
}

/// How many bytes the answer's files have.
#[unsafe(no_mangle)]
pub extern "C" fn bytes_length() -> usize {
    DESK.with_borrow(|desk| desk.bytes.len())
}

/// After a trap: puts what the panic said in the answer's text. The module must not be asked again.
#[unsafe(no_mangle)]
pub extern "C" fn last_words() {
    let words = PANIC.take().into_bytes();
    DESK.with_borrow_mut(|desk| desk.text = words);
}
