"""One picture in ranges of samples, on the workers of a Dask cluster; docs/farm.md says how to run it.

python render_dask.py MATERIAL.mtlx PICTURE [--size 960x540] [--parts 4] [--samples-per-part 16]
    [--scheduler ADDRESS]

The workers must see the folder of the picture. Without a scheduler's address a cluster of this machine's own is
started. A part whose worker is lost is rendered again, to the same bytes.
"""

import argparse
import pathlib
import subprocess

from distributed import Client, LocalCluster


def render(client, command, material, picture, size, parts, samples_per_part, retries=2):
    """Renders the parts on a client's workers, and merges them here."""
    folder = pathlib.Path(picture).resolve().parent

    def part(number):
        file = str(folder / f"part_{number}.exr")
        samples = f"{number * samples_per_part}..{(number + 1) * samples_per_part}"
        material_path = str(pathlib.Path(material).resolve())
        where = ["--samples", samples, "-o", file]
        subprocess.run([command, "render", material_path, "--size", size, "--threads", "1", *where], check=True)
        return file

    # Not pure: what a lost worker has written is not taken for done.
    files = client.gather(client.map(part, range(parts), retries=retries, pure=False))
    expect = f"0..{parts * samples_per_part}"
    subprocess.run([command, "merge", *files, "--expect", expect, "-o", picture], check=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("material")
    arguments.add_argument("picture")
    arguments.add_argument("--catseye", default="catseye", help="the command")
    arguments.add_argument("--size", default="960x540")
    arguments.add_argument("--parts", type=int, default=4)
    arguments.add_argument("--samples-per-part", type=int, default=16, help="a multiple of 4")
    arguments.add_argument("--scheduler", help="the address of a running cluster's scheduler")
    given = arguments.parse_args()
    cluster = given.scheduler or LocalCluster(threads_per_worker=1, dashboard_address=None)
    with Client(cluster) as client:
        picture = [given.material, given.picture, given.size]
        render(client, given.catseye, *picture, given.parts, given.samples_per_part)


if __name__ == "__main__":
    main()
