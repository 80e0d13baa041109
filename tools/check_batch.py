#!/usr/bin/env python3
"""Judges what `pocketry pocket BATCH.jsonl --out-dir DIR --report REPORT` has left behind.

    check_batch.py statuses REPORT... [--least 0.995]     share of regions that are proven
    check_batch.py rs274 REPORT... [--sample 200]         LinuxCNC's interpreter reads the programs
    check_batch.py referee --script referee.py --pairs BATCH.jsonl=REPORT ... [--sample 300] [--most-edges 2000]

Samples are the lines with the smallest SHA-256 of their id. The last two run on all cores. Exit status 1 where
something falls short; every shortfall is named.
"""
import argparse, concurrent.futures, hashlib, importlib.util, json, os, pathlib, subprocess, sys, tempfile

# LinuxCNC's interpreter, with the arc check set to 2 um. Its machine unit is the inch, and so is the tool table's.
STRICT = "[RS274NGC]\nCENTER_ARC_RADIUS_TOLERANCE_MM = 0.002\nCENTER_ARC_RADIUS_TOLERANCE_INCH = 0.0001\n"
TOOLS = "T1 P1 Z0 D0.25 ;end mill\n"
FIELDS = ["id", "status", "error", "program", "tool_radius", "stepover", "cut_length", "rapid_length", "retracts", "loops",
          "control_vertices", "gouge", "uncut_area", "unreachable_area", "seconds"]


def records(reports):
    for path in reports:
        with open(path) as lines:
            for line in lines:
                yield json.loads(line)


def by_hash(key):
    return hashlib.sha256(key.encode()).hexdigest()


def statuses(options):
    total, bad = 0, []
    for record in records(options.reports):
        total += 1
        missing = [f for f in FIELDS if f not in record]
        if missing:
            sys.exit(f"{record.get('id')}: the report lacks {missing}")
        if record["status"] != "proven":
            bad.append(record)
        elif not os.path.exists(record["program"]):
            sys.exit(f"{record['id']}: {record['program']} is said to be written and is not there")
    for record in bad:
        print(f"{record['status']}: {record['id']}: {record['error']['kind']}: {record['error']['message'][:160]}")
    share = 1 - len(bad) / max(total, 1)
    slowest = sorted(records(options.reports), key=lambda r: -r["seconds"])[:3]
    print(f"{total - len(bad)} of {total} proven ({100 * share:.2f} %); slowest:",
          ", ".join(f"{r['id']} {r['seconds']:.1f} s" for r in slowest))
    return total > 0 and share >= options.least


def interpreted(program):
    with tempfile.TemporaryDirectory() as folder:
        where = pathlib.Path(folder)
        (where / "strict.ini").write_text(STRICT)
        (where / "tools.tbl").write_text(TOOLS)
        command = ["rs274", "-g", "-n", "2", "-i", "strict.ini", "-t", "tools.tbl", "-v", "fresh.var", os.path.abspath(program)]
        # A home of its own: the interpreter keeps its tools in a file there.
        run = subprocess.run(command, cwd=folder, env=dict(os.environ, HOME=folder), stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300)
        said = [line for line in run.stderr.splitlines() if not line.startswith("executing") and "updating variable" not in line]
        return program, run.returncode == 0, " ".join(said)[-300:]


def rs274(options):
    proven = sorted((r for r in records(options.reports) if r["status"] == "proven"), key=lambda r: by_hash(r["id"]))
    sample = [r["program"] for r in proven[:options.sample]]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(interpreted, sample))
    for program, accepted, said in results:
        if not accepted:
            print(f"rejected: {program}: {said}")
    accepted = sum(r[1] for r in results)
    print(f"rs274 accepts {accepted} of {len(results)} programs")
    return bool(results) and accepted == len(results)


def fits_nowhere(record):
    return (record["error"] or {}).get("kind") == "does-not-fit"


def refereed(job):
    script, region, program, radius = job
    spec = importlib.util.spec_from_file_location("referee", script)
    referee = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(referee)
    try:
        if program is None:  # said to fit nowhere: then no centre has a clearance of the radius
            eroded = referee.region_polygon(region["loops"]).buffer(-radius)
            return region["id"], eroded.is_empty, {"eroded_area": eroded.area}
        with open(program) as text:
            figures, passed = referee.judge(region["loops"], text.read(), radius)
        return region["id"], passed, {k: figures[k] for k in ("gouge_depth", "outside", "uncut_spots", "uncut_radius", "uncut_area")}
    except Exception as fault:  # a referee that stumbles has not passed the program
        return region["id"], False, repr(fault)


def referee(options):
    sample = []
    for pair in options.pairs:
        batch, report = pair.split("=")
        lines = (json.loads(line) for line in open(batch) if line.strip())
        for region, record in zip(lines, records([report])):
            if sum(len(loop) for loop in region["loops"]) <= options.most_edges:
                sample.append((by_hash(region["id"]), region, record))
    sample.sort(key=lambda s: s[0])
    sample = sample[:options.sample]
    jobs = [(options.script, region, r["program"], r["tool_radius"] or region["tool_radius"]) for _, region, r in sample if r["status"] == "proven" or fits_nowhere(r)]
    for _, region, record in sample:
        if record["status"] != "proven" and not fits_nowhere(record):
            print(f"nothing to judge: {region['id']} is {record['status']}")
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(refereed, jobs, chunksize=4))
    for name, passed, figures in results:
        if not passed:
            print(f"short: {name}: {figures}")
    passed = sum(r[1] for r in results)
    print(f"the referee passes {passed} of {len(sample)}")
    return bool(sample) and passed == len(sample)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    p = commands.add_parser("statuses")
    p.add_argument("reports", nargs="+")
    p.add_argument("--least", type=float, default=0.995)
    p.set_defaults(run=statuses)
    p = commands.add_parser("rs274")
    p.add_argument("reports", nargs="+")
    p.add_argument("--sample", type=int, default=200)
    p.set_defaults(run=rs274)
    p = commands.add_parser("referee")
    p.add_argument("--script", required=True)
    p.add_argument("--pairs", nargs="+", required=True)
    p.add_argument("--sample", type=int, default=300)
    p.add_argument("--most-edges", type=int, default=2000)
    p.set_defaults(run=referee)
    options = parser.parse_args()
    return 0 if options.run(options) else 1


if __name__ == "__main__":
    sys.exit(main())
