# An optimiser of one's own drives nacre's testers: coordinate search, one free pixel after the other, for E * E[T].
# `python3 examples/ask_tell.py build/bin/nacre gamut.csv [TESTS [FIDELITY]]`; again, it begins at further patterns with
# what is left of the fracture tests.
import json
import subprocess
import sys

FREE_PIXELS = 55
SPECIMENS = 2

program, out = sys.argv[1:3]
tests = int(sys.argv[3]) if len(sys.argv) > 3 else 200
fidelity = sys.argv[4] if len(sys.argv) > 4 else "preview"
nacre = subprocess.Popen(
    [program, "explore", "--ask-tell", "--algorithm", "random", "--seed", "7", "--budget", str(tests)]
    + ["--fidelity", fidelity, "--out", out],
    stdin=subprocess.PIPE,
    stdout=subprocess.PIPE,
    text=True,
)


def response():
    answer = json.loads(nacre.stdout.readline())
    if "error" in answer:
        sys.exit(answer["error"])
    return answer


def request(kind, **members):
    print(json.dumps({"request": kind, **members}), file=nacre.stdin, flush=True)
    return response()


def tested(patterns):
    """E and T of patterns, T the mean over specimens, and how many fracture tests are left."""
    answer = request("test", patterns=patterns, specimens=SPECIMENS)
    return answer["samples"], answer["tests_left"]


def merit(sample):
    return sample.get("modulus_pa", 0.0) * sample.get("toughness_pa", 0.0)


standing = response()
# nacre's own random patterns to begin with: asked for, tested and told.
batch = standing["awaited"] or request("ask")["patterns"]
samples, tests_left = tested(batch)
request("tell", samples=samples)
best = max(samples, key=merit)
print(f"start  {best['pattern']}  {merit(best) / 1e15:.4f} GPa MPa")

for pixel in range(FREE_PIXELS):
    if tests_left < SPECIMENS:
        break
    flipped = f"{int(best['pattern'], 16) ^ (1 << pixel):014x}"
    (sample,), tests_left = tested([flipped])
    if merit(sample) > merit(best):
        best = sample
        error = sample["toughness_se_pa"]
        print(f"{pixel:5}  {best['pattern']}  {merit(best) / 1e15:.4f} GPa MPa, T +- {error / 1e6:.3f} MPa")
nacre.stdin.close()
sys.exit(nacre.wait())
