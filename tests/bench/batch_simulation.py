"""Replays the plan of a long shot on many nodes, with the pass times and files of a batch that has run. It prints when the shot
would be finished, the critical path, the idle nodes, and the traffic of the shared file system.
    batch_simulation.py PLAN_FOLDER [--frames 2000] [--nodes 500] [--scale 1]
The tasks of the batch are repeated until there are that many frames, except for tasks that all frames share (photons, maps of
light, Make requests). Each task takes the CPU time that it took in the batch, times --scale (frames of the test are small), and
reads and writes the same files. Nodes take tasks in the order of the plan once the tasks that these depend on are done, --launch
seconds after the node is free (Slurm's latency). No more than --rate tasks begin per second (Slurm's controller). A task waits
for its files over a link of --link bytes per second."""
import argparse
import collections
import heapq
import json
import pathlib

parser = argparse.ArgumentParser()
parser.add_argument("plan", type=pathlib.Path)
parser.add_argument("--frames", type=int, default=2000)
parser.add_argument("--nodes", type=int, default=500)
parser.add_argument("--scale", type=float, default=1)
parser.add_argument("--launch", type=float, default=1)
parser.add_argument("--rate", type=float, default=50)
parser.add_argument("--link", type=float, default=5e8)
given = parser.parse_args()
SHARED = ("photons", "joinphotons", "lightmaps", "maps", "make")
Task = collections.namedtuple("Task", "name stage needs seconds read written")


def tasks():
    """Returns the tasks of the plan that has run, with their measured costs, and the number of frames."""
    plan = json.loads((given.plan / "plan.json").read_text())["tasks"]
    states = {t["name"]: json.loads((given.plan / "state" / (t["name"] + ".json")).read_text()) for t in plan}
    sizes = {file: size for t in plan for file, size in zip(t["makes"], states[t["name"]]["bytes"])}
    out = [Task(t["name"], t["stage"], t["needs"], states[t["name"]]["cpu_s"] * given.scale,
                sum(sizes.get(a, 0) for a in t["arguments"] if a not in t["makes"]), sum(states[t["name"]]["bytes"])) for t in plan]
    return out, len({t["frame"] for t in plan if not t["stage"].startswith(SHARED)})


def repeated(some, times):
    shared = {t.name for t in some if t.stage.startswith(SHARED)}
    out = [t for t in some if t.name in shared]
    for k in range(times):
        out += [t._replace(name=f"{k} {t.name}", needs=[n if n in shared else f"{k} {n}" for n in t.needs]) for t in some if t.name not in shared]
    return out


def duration(task):
    return given.launch + task.seconds + (task.read + task.written) / given.link


def replay(all_tasks, nodes):
    """Assigns the first task that may run to the earliest free node. Returns the seconds until all tasks are done, the seconds
    that nodes have worked, and the bytes of each second."""
    place = {t.name: i for i, t in enumerate(all_tasks)}
    missing, followers = [len(t.needs) for t in all_tasks], collections.defaultdict(list)
    for i, t in enumerate(all_tasks):
        for n in t.needs:
            followers[place[n]].append(i)
    ready, running, free = [i for i, n in enumerate(missing) if n == 0], [], nodes
    now = begun = busy = 0.0
    traffic = collections.Counter()
    while ready or running:
        while ready and free > 0:
            task = all_tasks[ready[0]]
            begun = max(now, begun + 1 / given.rate)
            end = begun + duration(task)
            heapq.heappush(running, (end, heapq.heappop(ready)))
            busy += task.seconds
            free -= 1
            traffic[int(begun)] += task.read
            traffic[int(end)] += task.written
        now, done = heapq.heappop(running)
        free += 1
        for i in followers[done]:
            missing[i] -= 1
            if missing[i] == 0:
                heapq.heappush(ready, i)
    return now, busy, traffic


def critical_path(all_tasks):
    """Returns the longest chain, as if each task had a node of its own."""
    at, chain = {}, {}
    for t in all_tasks:  # A task stands after those that it needs.
        before = max(t.needs, key=at.get, default=None)
        at[t.name], chain[t.name] = at.get(before, 0) + duration(t), chain.get(before, []) + [t.stage]
    end = max(at, key=at.get)
    return at[end], chain[end]


some, frames = tasks()
shot = repeated(some, -(-given.frames // frames))
stages = collections.defaultdict(list)
for t in some:
    stages[t.stage].append(t.seconds)
print(f"{len(shot)} tasks; seconds of one: " + ", ".join(f"{stage} {sum(v) / len(v):.0f}" for stage, v in stages.items()))
seconds, chain = critical_path(shot)
print(f"critical path {seconds:.0f} s: {' > '.join(chain)}")
print(f"all work {sum(t.seconds for t in shot) / 3600:.0f} node hours; {sum(t.read for t in shot) / 1e9:.1f} GB read, {sum(t.written for t in shot) / 1e9:.1f} GB written")
for nodes in (given.nodes // 5, given.nodes, given.nodes * 5):
    end, busy, traffic = replay(shot, nodes)
    print(f"{nodes} nodes: done after {end:.0f} s, {100 - 100 * busy / (nodes * end):.1f} % of their time idle; "
          f"{sum(traffic.values()) / end / 1e6:.1f} MB/s in the mean, {max(traffic.values()) / 1e6:.0f} MB in the busiest second; {len(shot) / end:.1f} tasks begin a second")
