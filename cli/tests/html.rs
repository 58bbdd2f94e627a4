//! The page of a run: what is in it, and in a browser, where there is one.

#[path = "support/folder.rs"]
mod folder;
#[path = "support/run.rs"]
mod run;

use std::fs;
use std::process::Command;

use chamfer::{MeshBuffers, shapes};
use chamfer_formats::glb;

use folder::Folder;

fn write(folder: &Folder, name: &str, mesh: &MeshBuffers) {
    let path = folder.path(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, glb::encode("part", mesh, &[], &[]).unwrap()).unwrap();
}

/// A box of so many centimetres' height.
fn slab(height: f32) -> MeshBuffers {
    let mut slab = shapes::plain_cube(1.0);
    slab.positions.iter_mut().for_each(|position| position[1] *= height / 100.0);
    slab
}

/// Four models: one that cannot be read, a smooth one, a narrowed one with a strange name, and one
/// that is full.
fn page() -> (Folder, String) {
    let folder = Folder::with(&[("in/broken.obj", "v 0 0 0\nf 1 2 3\n")]);
    write(&folder, "in/a full.glb", &slab(100.0));
    write(&folder, "in/n<arrow> & co.glb", &slab(2.0));
    let mut smooth = slab(100.0);
    smooth.normals.fill([0.0, 1.0, 0.0]);
    write(&folder, "in/smooth.glb", &smooth);
    folder.run("in -o out --html pages/all.html --width 0.05").exits(1);
    let page = folder.text("pages/all.html");
    (folder, page)
}

#[test]
fn a_page_has_all_models_the_worst_on_top() {
    let (folder, page) = page();
    let rows: Vec<&str> = page.split("<tbody>").nth(1).unwrap().split("<tr ").skip(1).collect();
    let order = ["broken.obj", "n&lt;arrow&gt; &amp; co.glb", "a full.glb", "smooth.glb"];
    assert_eq!(rows.len(), order.len());
    for (row, name) in rows.iter().zip(order) {
        assert!(row.contains(name), "{name}: {row}");
        let pictures = row.matches("src=\"data:image/png;base64,").count();
        assert_eq!(pictures, if name == "broken.obj" { 0 } else { 2 });
    }
    assert!(rows[0].starts_with("class=\"failed\"") && rows[0].contains("vertex 2 of 1"));
    assert!(rows[1].starts_with("class=\"narrow\"") && rows[1].contains("12 (0."));
    assert!(rows[3].contains("all its normals are smooth"));
    // What is linked is there.
    let links: Vec<&str> =
        page.split("href=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    assert_eq!(links.len(), 7);
    for link in links {
        let link =
            link.replace("%20", " ").replace("%3C", "<").replace("%3E", ">").replace("%26", "&");
        assert!(folder.path("pages").join(&link).exists(), "{link}");
    }
    // Of 24 chamfers 12 are full, and four more have nearly all of the width.
    assert!(page.contains("<title>0.9 to 1.0: 16</title>"), "{page}");
    assert!(page.contains("<td>full</td><td>12</td><td>50.0 %</td>"));
}

#[test]
fn a_page_asks_no_network_for_anything() {
    let (_folder, page) = page();
    assert!(page.contains("default-src 'none'"));
    for word in ["http:", "https:", "//cdn", "@import", "url(", "<link", "<iframe", "fetch("] {
        assert!(!page.contains(word), "{word}");
    }
    assert_eq!(page.matches("src=").count(), page.matches("src=\"data:image/png;base64,").count());
}

fn browser() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    names.into_iter().find(|name| Command::new(name).arg("--version").output().is_ok())
}

/// What a browser makes of a page once this script has run in it.
fn dom(folder: &Folder, browser: &str, page: &str, script: &str) -> String {
    let script = format!("<script>window.onload = () => {{ {script} }};</script></body>");
    fs::write(folder.path("pages/tried.html"), page.replace("</body>", &script)).unwrap();
    let mut command = Command::new(browser);
    command.args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"]);
    command.arg(format!("--user-data-dir={}", folder.path("profile").display()));
    command.arg(format!("file://{}", folder.path("pages/tried.html").display()));
    let output = command.output().unwrap();
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn a_browser_shows_the_pictures_and_sorts_the_table() {
    let Some(browser) = browser() else {
        eprintln!("SKIPPED: no Chromium: the page is not opened in a browser");
        return;
    };
    let (folder, page) = page();
    let names = "[...table.tBodies[0].rows].map((row) => row.cells[0].querySelector('a').textContent).join('|')";
    let told = |script: &str| {
        let dom = dom(&folder, browser, &page, &format!("document.title = {script};"));
        dom.split("<title>").nth(1).unwrap_or_default().split("</title>").next().unwrap().to_owned()
    };
    assert_eq!(
        told("[...document.images].map((image) => image.naturalWidth).join()"),
        "400,400,400,400,400,400"
    );
    let [broken, narrow, full, smooth] =
        ["in/broken.obj", "in/n&lt;arrow&gt; &amp; co.glb", "in/a full.glb", "in/smooth.glb"];
    let sorted = |clicks: &str| told(&format!("({clicks}, {names})"));
    assert_eq!(sorted("0"), [broken, narrow, full, smooth].join("|"));
    assert_eq!(sorted("heads[0].click()"), [full, broken, narrow, smooth].join("|"));
    // By triangles, most first: those that were chamfered, in the order that they had.
    assert_eq!(
        sorted("heads[8].click(), heads[8].click()"),
        [narrow, full, smooth, broken].join("|")
    );
}
