//! Farms: the job templates give the bytes of one render, also where a task is lost on the way.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::python::{passes, required, root};
use crate::run::Bench;

const COMMAND: &str = env!("CARGO_BIN_EXE_catseye");

/// A material in the bench's folder.
fn material(bench: &Bench) -> PathBuf {
    let path = bench.path("retro.mtlx");
    fs::copy(root().join("materials/retro_roughness_015.mtlx"), &path).unwrap();
    path
}

/// The picture that 4 parts of 8 samples are of.
fn whole(bench: &Bench, size: &str) -> Vec<u8> {
    let outcome = bench.catseye(&format!("render retro.mtlx {size} --spp 32 -o whole.png"), "");
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    fs::read(bench.path("whole.png")).unwrap()
}

#[test]
fn an_open_job_description_template_renders_in_parts() {
    let jobs = root().join("jobs");
    let Some(python) = required(&jobs, "farm", "jobs/render.template.yaml") else { return };
    let bench = Bench::new();
    let material = material(&bench);
    let openjd = |step: &str, more: &[&str]| {
        let mut command = Command::new(python.with_file_name("openjd"));
        command.arg("run").arg(jobs.join("render.template.yaml")).args(["--step", step]).args(more);
        for parameter in [
            format!("Catseye={COMMAND}"),
            format!("Material={}", material.display()),
            format!("Folder={}", bench.path(".").display()),
            "Size=48x27".to_owned(),
            "SamplesPerPart=8".to_owned(),
        ] {
            command.args(["-p", &parameter]);
        }
        command
    };
    passes(&mut openjd("Merge", &["--run-dependencies"]), "the job");
    let whole = whole(&bench, "--size 48x27");
    assert!(fs::read(bench.path("picture.png")).unwrap() == whole);

    // Without one of the parts the job fails, and with that task run again it is done.
    fs::remove_file(bench.path("picture.png")).unwrap();
    fs::remove_file(bench.path("part_2.exr")).unwrap();
    let outcome = openjd("Merge", &["--no-run-dependencies"]).output().unwrap();
    let said = String::from_utf8_lossy(&outcome.stdout).into_owned();
    assert!(!outcome.status.success() && said.contains("part_2.exr: can't be read"), "{said}");
    passes(&mut openjd("Render", &["--task-param", "Part=2"]), "one task");
    passes(&mut openjd("Merge", &["--no-run-dependencies"]), "the merge");
    assert!(fs::read(bench.path("picture.png")).unwrap() == whole);
}

#[test]
fn a_dask_cluster_that_loses_a_worker_gives_the_same_picture() {
    const SCRIPT: &str = "
import glob, os, signal, sys, threading, time
from distributed import Client, LocalCluster
import render_dask

if __name__ == '__main__':
    folder, command, material = sys.argv[1:]
    cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with cluster, Client(cluster) as client:
        workers = client.run(os.getpid)
        def lose_a_worker():
            while not glob.glob(folder + '/part_*.exr'):
                time.sleep(0.01)
            os.kill(list(workers.values())[0], signal.SIGKILL)
        threading.Thread(target=lose_a_worker).start()
        render_dask.render(client, command, material, folder + '/picture.png', '320x180', 4, 8)
        assert set(client.run(os.getpid).values()) != set(workers.values()), 'a worker was lost'
";
    let jobs = root().join("jobs");
    let Some(python) = required(&jobs, "farm", "jobs/render_dask.py") else { return };
    let bench = Bench::new();
    bench.write("lose_a_worker.py", SCRIPT);
    let material = material(&bench);
    let mut command = Command::new(python);
    command.arg(bench.path("lose_a_worker.py")).arg(bench.path(".")).arg(COMMAND).arg(&material);
    passes(command.env("PYTHONPATH", &jobs), "the picture");
    assert!(fs::read(bench.path("picture.png")).unwrap() == whole(&bench, "--size 320x180"));
}
