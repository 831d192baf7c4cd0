//! Every reader of the library, one entry each: bytes in, and whether they were taken. The tests of this folder and the targets of
//! `fuzz/` walk this list. A reader may refuse; it may not panic, hang, or take what is not what it says.

use std::io::Cursor;
use std::sync::{Arc, LazyLock, Mutex};

use flexframe::checks::gate::Baseline;
use flexframe::export::{glb, stl};
use flexframe::frame::assembly::Design;
use flexframe::frame::assembly::mass::{self, MassTable};
use flexframe::impact::effects::Model;
use flexframe::impact::measured::{
    DropTable, FileFormat, FoldReading, JudgedDrops, StaticTest, TableFormat, fold_readings, read_bytes, scale_readings,
};
use flexframe::impact::synthetic::Plan;
use flexframe::mechanics::settings::MechanicsSettings;
use flexframe::params::amend::{Amendment, amended};
use flexframe::params::files::Memory;
use flexframe::params::frame_file::Value;
use flexframe::params::refusal::Refusal;
use flexframe::params::{Frame, FrameFile, ImpactFile, LoadError};
use flexframe::printing::coupon::{FOLDS, FoldedHinge, Found, HingeLimit, Hinges};
use flexframe::solid::Mesh;
use flexframe::study::{Journal, Study, Subject, load, samples};
use flexframe::variant::{Goal, Increase};
use nalgebra::Point3;

/// A reader.
pub struct Reader {
    /// Its name, and that of its folders in `fuzz/`.
    pub name: &'static str,
    /// Reads bytes; whether it took them.
    pub read: fn(&[u8]) -> bool,
}

/// All of them.
pub const READERS: [Reader; 19] = [
    Reader { name: "frame_files", read: frame_file },
    Reader { name: "amended_frames", read: amended_frame },
    Reader { name: "impact_models", read: |bytes| impact_file(bytes, impact_model) },
    Reader { name: "synthetic_plans", read: |bytes| impact_file(bytes, |file| Plan::resolve(file).map(drop)) },
    Reader { name: "mechanics_settings", read: |bytes| impact_file(bytes, mechanics_settings) },
    Reader { name: "study_plans", read: |bytes| study(&[("fuzz.toml", bytes)]) },
    Reader { name: "study_samples", read: study_samples },
    Reader { name: "study_journals", read: study_journal },
    Reader { name: "logger_files", read: |bytes| drops("soft_050cm/fuzz.bin", bytes) },
    Reader { name: "drop_tables", read: |bytes| drops("soft_050cm/fuzz.csv", bytes) },
    Reader { name: "covariate_tables", read: covariate_table },
    Reader { name: "scale_readings", read: |bytes| scale_readings("fuzz.csv", bytes).map_err(|malformed| malformed.to_string()).is_ok() },
    Reader { name: "fold_readings", read: fold_table },
    Reader {
        name: "static_tests",
        read: |bytes| StaticTest::read_bytes("fuzz.csv", bytes).map_err(|malformed| malformed.to_string()).is_ok(),
    },
    Reader { name: "accepted_findings", read: accepted_findings },
    Reader { name: "goals", read: goal },
    Reader { name: "coupon_findings", read: coupon_findings },
    Reader { name: "table_formats", read: table_format },
    Reader { name: "mesh_files", read: mesh_files },
];

/// What some readers need beside their input, made once.
static FILE: LazyLock<FrameFile> = LazyLock::new(|| FrameFile::load("cognifly").expect("is a preset"));
static FRAME: LazyLock<Frame> = LazyLock::new(|| Frame::resolve(&FILE).expect("is a frame"));
static DESIGN: LazyLock<Mutex<(Design, MassTable)>> = LazyLock::new(|| {
    let mut design = Design::new(FRAME.clone()).expect("can be made");
    let masses = mass::table(&design);
    // One body of one shape is all that a mesh needs of an assembly.
    design.bodies.truncate(1);
    design.bodies[0].shape = 0;
    design.shapes.truncate(1);
    Mutex::new((design, masses))
});
static SAMPLED: LazyLock<ImpactFile> = LazyLock::new(|| ImpactFile::parse("fuzz.toml", "table = \"fuzz.csv\"\n").expect("is a plan"));
static STUDY: LazyLock<Study> = LazyLock::new(|| {
    let plan = b"samples = 8\nmeasures = [\"mass\", \"peak\"]\n[vary]\ncage_rod = [100, 200]\n";
    load("fuzz.toml", &memory(&[("fuzz.toml", plan)])).expect("is a plan")
});

/// Makes what a reader needs beside its input, so that no input is charged for it.
pub fn prepared(name: &str) {
    match name {
        "mesh_files" => drop(LazyLock::force(&DESIGN)),
        "study_journals" => drop(LazyLock::force(&STUDY)),
        "study_samples" => drop(LazyLock::force(&SAMPLED)),
        _ => drop(LazyLock::force(&FRAME)),
    }
}

/// The reader of a name.
pub fn by_name(name: &str) -> &'static Reader {
    READERS.iter().find(|reader| reader.name == name).expect("is in the list")
}

fn memory(files: &[(&str, &[u8])]) -> Memory {
    Memory(files.iter().map(|(path, bytes)| (path.into(), bytes.to_vec())).collect())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Whether there was no refusal; one is rendered as a terminal shows it.
fn taken<T>(result: Result<T, LoadError>) -> bool {
    match result {
        Ok(_) => true,
        Err(LoadError::Refused(refusal)) => refused(&refusal),
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    }
}

fn refused(refusal: &Refusal) -> bool {
    assert!(!refusal.message().is_empty() && !refusal.remedy().is_empty() && !refusal.render().is_empty());
    if let Some(place) = &refusal.place {
        let [line, column] = place.line_column();
        assert!(line > 0 && column > 0 && place.span.start <= place.span.end && place.span.end <= place.source.text.len());
    }
    false
}

fn frame_file(bytes: &[u8]) -> bool {
    taken(FrameFile::load_from("fuzz.toml", &memory(&[("fuzz.toml", bytes)])).and_then(|file| Ok(Frame::resolve(&file)?)))
}

/// What the commands write into a frame file stands in it, and is read again.
fn amended_frame(bytes: &[u8]) -> bool {
    let key = "override.materials.\"a b\".print_factor";
    let amendments = [
        Amendment { key: "fit.plug_clearance_mm", value: Some(&Value::Number(0.25)), why: "found on the coupon" },
        Amendment { key, value: Some(&Value::Number(0.5)), why: "" },
        Amendment { key: "rods.arm_rod_length_mm", value: None, why: "" },
    ];
    // A command amends what it has read.
    let before = text(bytes);
    if ImpactFile::parse("before", &before).is_err() {
        return false;
    }
    let Ok(after) = amended(&before, &amendments) else { return false };
    let file = ImpactFile::parse("amended", &after).unwrap_or_else(|refusal| panic!("{}\n{after}", refusal.render()));
    let number = |key: &str| file.entries.get(key).map(|entry| entry.value.clone());
    assert_eq!(number("fit.plug_clearance_mm"), Some(Value::Number(0.25)), "{after}");
    assert_eq!(number("override.materials.a b.print_factor"), Some(Value::Number(0.5)), "{after}");
    assert_eq!(number("rods.arm_rod_length_mm"), None, "{after}");
    true
}

fn impact_file(bytes: &[u8], resolve: impl Fn(&ImpactFile) -> Result<(), Refusal>) -> bool {
    let file = ImpactFile::load_from("fuzz.toml", &memory(&[("fuzz.toml", bytes)]));
    taken(file.and_then(|file| Ok(resolve(&file)?)))
}

/// A model that reads is the same when it is written and read again.
fn impact_model(file: &ImpactFile) -> Result<(), Refusal> {
    let text = Model::resolve(file)?.to_toml();
    let again = ImpactFile::parse(&file.name, &text).and_then(|file| Model::resolve(&file));
    assert_eq!(again.map(|model| model.to_toml()).map_err(|refusal| refusal.render()), Ok(text));
    Ok(())
}

/// Numbers that read are the same when they are written and read again.
fn mechanics_settings(file: &ImpactFile) -> Result<(), Refusal> {
    let settings = MechanicsSettings::read(file)?;
    let written = ImpactFile::parse(&settings.name, &settings.to_toml("")).and_then(|file| MechanicsSettings::read(&file));
    assert_eq!(written.map_err(|refusal| refusal.render()), Ok(settings));
    Ok(())
}

/// A plan that reads has rows, and a frame file in the first and in the last of them.
fn study(files: &[(&str, &[u8])]) -> bool {
    taken(load("fuzz.toml", &memory(files)).map(|study| {
        // A Latin hypercube is laid out as a whole for its first row; a large one says nothing more than a small one.
        let rows = study.rows();
        for row in [0, rows - 1].into_iter().filter(|_| rows <= 1000) {
            assert_eq!(study.inputs(row).len(), study.axes.len());
            if let Subject::Frames(frames) = &study.subject {
                let _ = Frame::resolve(&study.frame_file(frames, row)).map_err(|refusal| refused(&refusal));
            }
        }
    }))
}

/// What samples are of.
static BASE: LazyLock<(FrameFile, Frame)> = LazyLock::new(|| {
    let file = FrameFile::load("cognifly").expect("a preset");
    let frame = Frame::resolve(&file).expect("is one");
    (file, frame)
});

/// Each row has a figure or a name for each column. That rows become frames is for `study_plans` and `amended_frames`.
fn study_samples(bytes: &[u8]) -> bool {
    taken(samples(&SAMPLED, "table.csv", &text(bytes), &BASE.0, &BASE.1).map_err(LoadError::Refused).map(|(axes, rows)| {
        assert!(!rows.is_empty() && rows.iter().all(|row| row.len() == axes.len()));
    }))
}

fn study_journal(bytes: &[u8]) -> bool {
    let journal = Journal::read(&STUDY, bytes);
    if let Ok(journal) = &journal {
        assert!(journal.whole <= bytes.len());
    }
    journal.map_err(|error| error.to_string()).is_ok()
}

/// Records that read are finite, in order of time, and can be judged.
fn drops(name: &str, bytes: &[u8]) -> bool {
    let set = match read_bytes(&[(name.into(), bytes.to_vec())], &FileFormat::default()) {
        Ok(set) => set,
        Err(malformed) => {
            assert!(malformed.to_string().starts_with(name) && !malformed.fault.remedy().is_empty());
            return false;
        }
    };
    for record in set.records() {
        assert!(record.t_s.len() == record.accel_g.len() && record.t_s.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(record.accel_g.iter().all(|reading| reading.is_finite()));
    }
    let judged = JudgedDrops::of(&set);
    assert_eq!(judged.groups.len(), set.groups.len());
    true
}

fn covariate_table(bytes: &[u8]) -> bool {
    static DROPS: &[u8] = b"trial,height_m,t_s,accel_g\n1,0.5,0,0\n1,1,0,0\n2,1,0,0\n";
    match DropTable::read_bytes("fuzz.csv", bytes) {
        Ok(table) => {
            let mut set = read_bytes(&[("drops.csv".into(), DROPS.to_vec())], &FileFormat::default()).expect("reads");
            assert!(table.add_to(&mut set) <= 3);
            true
        }
        Err(malformed) => {
            assert!(malformed.to_string().starts_with("fuzz.csv"));
            false
        }
    }
}

/// A list that reads is the same when it is written and read again.
fn accepted_findings(bytes: &[u8]) -> bool {
    match Baseline::parse(&text(bytes)) {
        Ok(list) => {
            assert_eq!(Baseline::parse(&list.text()).expect("is what was written"), list);
            true
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    }
}

/// A goal that reads is the same as it is reported.
fn goal(bytes: &[u8]) -> bool {
    let text = text(bytes);
    let goal = Goal::parse(&text).map_err(|error| error.to_string());
    if let Ok(goal) = &goal {
        assert!(goal.limit.is_finite(), "{text}");
        let again = Goal::parse(&goal.reported()).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!((again.measure.name, again.limit), (goal.measure.name, goal.limit), "{text}");
    }
    let increase = Increase::parse(&text).map_err(|error| error.to_string());
    if let Ok(increase) = &increase {
        assert!(increase.most.is_finite() && increase.most >= 0.0, "{text}");
    }
    goal.is_ok() | increase.is_ok()
}

/// Findings that read set parameters within their bounds.
fn coupon_findings(bytes: &[u8]) -> bool {
    let words = text(bytes);
    let found: Result<Vec<Found>, _> = words.split(',').map(Found::parse).collect();
    let set = found.and_then(|found| Found::parameters(&FRAME, &found));
    set.map_err(|error| error.to_string()).is_ok_and(|set| {
        let mut file = FILE.clone();
        set.iter().for_each(|(key, value)| file.set_number(key, *value));
        // What contradicts another number of the frame is refused; what is out of a parameter's own bounds would be our fault.
        let resolved = Frame::resolve(&file).map_err(|refusal| refusal.message());
        assert!(!matches!(&resolved, Err(message) if message.contains("out of bounds")), "{words}: {resolved:?}");
        true
    })
}

/// Folded hinges that give a factor give one that divides the elongation into a strain that held.
fn fold_table(bytes: &[u8]) -> bool {
    let Ok(readings) = fold_readings("fuzz.csv", bytes, FOLDS) else { return false };
    let folded =
        |one: &FoldReading| FoldedHinge { thickness_mm: one.thickness_mm, fold_deg: one.fold_deg, cracked_after: one.cracked_after };
    let hinges = Hinges::of(&FRAME).expect("the preset closes");
    let limit = HingeLimit::of(&FRAME, &hinges, &readings.iter().map(folded).collect::<Vec<_>>());
    if let Ok(limit) = &limit {
        assert!(
            (1.0..=20.0).contains(&limit.factor) && limit.held.strain_percent * limit.factor >= 0.999 * limit.elongation_percent,
            "{limit:?}"
        );
    }
    limit.map_err(|(_, error)| error.to_string()).is_ok()
}

/// Columns, units and rate, a line each, as the command line gives them.
fn table_format(bytes: &[u8]) -> bool {
    let text = text(bytes);
    let mut lines = text.lines();
    let mut words = || lines.next().unwrap_or_default().split(',').filter(|word| !word.is_empty()).map(String::from).collect::<Vec<_>>();
    let (columns, units, rate) = (words(), words(), words());
    let rate_hz = rate.first().and_then(|rate| rate.parse().ok());
    TableFormat::new(&columns, &units, rate_hz).map_err(|error| error.to_string()).is_ok()
}

/// A mesh that the export gate would not call empty, written as STL and GLB, is read by other readers as it was.
fn mesh_files(bytes: &[u8]) -> bool {
    let Some(mesh) = mesh(bytes).filter(|mesh| !mesh.triangles.is_empty()) else { return false };
    let file = stl::binary(&mesh).expect("memory takes it");
    let read = stl_io::create_stl_reader(&mut Cursor::new(&file)).expect("is an STL").collect::<Result<Vec<_>, _>>().expect("reads");
    assert_eq!(read.len(), mesh.triangles.len());
    for (facet, triangle) in read.iter().zip(&mesh.triangles) {
        let corners = triangle.map(|corner| mesh.vertices[corner as usize]);
        assert!((0..3).all(|at| facet.vertices[at].0 == corners[at]));
        let length = facet.normal.0.iter().map(|part| part * part).sum::<f32>();
        assert!(length == 0.0 || (length - 1.0).abs() < 1e-5, "a normal of length {length}");
    }
    same_in_glb(&Arc::new(mesh));
    true
}

fn same_in_glb(mesh: &Arc<Mesh>) {
    let mut held = DESIGN.lock().expect("no reader failed while it held it");
    held.0.shapes[0].mesh = Arc::clone(mesh);
    let file = glb::frame(&held.0, &held.1).expect("can be written");
    drop(held);
    let gltf = gltf::Gltf::from_slice(&file).expect("is glTF");
    let binary = gltf.blob.as_deref().expect("has a binary chunk");
    let primitive = gltf.meshes().next().and_then(|mesh| mesh.primitives().next()).expect("has a primitive");
    let reader = primitive.reader(|_| Some(binary));
    let positions: Vec<[f32; 3]> = reader.read_positions().expect("has positions").collect();
    let metres: Vec<[f32; 3]> = mesh.vertices.iter().map(|vertex| vertex.map(|mm| (f64::from(mm) / 1000.0) as f32)).collect();
    assert_eq!(positions, metres);
    let indices: Vec<u32> = reader.read_indices().expect("has indices").into_u32().collect();
    assert_eq!(indices, mesh.triangles.concat());
}

/// A mesh of any bytes: the first says how many corners, three numbers each, and what is left are triangles. Numbers are thousandths
/// of a millimetre, so that corners meet now and then, or any finite f32.
fn mesh(bytes: &[u8]) -> Option<Mesh> {
    let (&[head, kind], rest) = bytes.split_first_chunk::<2>()?;
    let (width, count) = (if kind % 2 == 0 { 2 } else { 4 }, 1 + usize::from(head) % 64);
    let (corners, triangles) = rest.split_at_checked(3 * width * count)?;
    let number = |bytes: &[u8]| match *bytes {
        [a, b] => f64::from(i16::from_le_bytes([a, b])) / 1000.0,
        [a, b, c, d] => f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => f64::NAN,
    };
    let numbers: Vec<f64> = corners.chunks_exact(width).map(number).collect();
    let positions: Vec<Point3<f64>> = numbers.chunks_exact(3).map(|at| Point3::new(at[0], at[1], at[2])).collect();
    let corner = |byte: u8| u32::from(byte) % count as u32;
    let triangles: Vec<[u32; 3]> = triangles.chunks_exact(3).map(|at| [corner(at[0]), corner(at[1]), corner(at[2])]).collect();
    numbers.iter().all(|number| number.is_finite()).then(|| Mesh::canonical(&positions, &triangles))
}
