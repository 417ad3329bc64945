"""The Python module: what it returns is, to the last bit, what the command line prints."""

import ast
import inspect
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import nacre
import numpy as np

NACRE = os.environ["NACRE"]
SOURCE = pathlib.Path(os.environ["NACRE_SOURCE"])
PUBLISHED = str(SOURCE / "data/patterns/published_a.txt")


def told(*words, status=0):
    """The JSON document of a command."""
    done = subprocess.run([NACRE, *map(str, words), "--json"], capture_output=True, text=True, check=False)
    assert done.returncode == status, done.stderr
    return json.loads(done.stdout)


def without_speed(entry):
    """What two runs of the same simulation have in common."""
    return {key: value for key, value in entry.items() if key not in ("element_steps_per_s", "curves", "film")}


class Simulate(unittest.TestCase):
    def test_two_designs_are_those_of_the_command_line(self):
        there = told("simulate", PUBLISHED, "mix:0.65", "--fidelity", "preview", "--specimens", 3)
        here = nacre.simulate([PUBLISHED, "mix:0.65"], fidelity="preview", specimens=3)
        self.assertEqual([without_speed(e) for e in here], [without_speed(e) for e in there])
        self.assertGreater(here[0]["modulus_pa"], 1e8)
        self.assertGreater(here[0]["toughness_pa"], 1e5)

    def test_specimens_parameters_and_criterion_are_those_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "params.toml"
            file.write_text("[toughness]\nw_if_j_per_m3 = 2e6\n")
            there = told("simulate", PUBLISHED, "--fidelity", "tiny", "--specimens", 3, "--strength-cv", 0.1,
                         "--criterion", "neighbourhood", "--test", "toughness", "--params", file)
            here = nacre.simulate(PUBLISHED, fidelity="tiny", specimens=3, strength_cv=0.1, criterion="neighbourhood",
                                  test="toughness", params=file)
        by_dict = nacre.simulate(PUBLISHED, fidelity="tiny", specimens=3, strength_cv=0.1, criterion="neighbourhood",
                                 test="toughness", params={"toughness": {"w_if_j_per_m3": 2e6}})
        self.assertEqual(without_speed(here), without_speed(there[0]))
        self.assertEqual(without_speed(by_dict), without_speed(here))
        self.assertEqual(len(here["curves"]), 3)

    def test_a_letter_a_key_a_file_and_an_array_are_one_design(self):
        pixels = np.array([[int(c) for c in line] for line in pathlib.Path(PUBLISHED).read_text().split()])
        self.assertEqual(pixels.shape, (20, 20))
        forms = ["a", "577fffe9fffdef", pathlib.Path(PUBLISHED), pixels, pixels == 1, pixels.astype(float)]
        results = nacre.simulate(forms, fidelity="tiny")
        self.assertEqual({r["key"] for r in results}, {"577fffe9fffdef"})
        self.assertEqual(len({r["toughness_pa"] for r in results}), 1)
        self.assertEqual(len(nacre.simulate(np.stack([pixels, 1 - pixels]), fidelity="tiny", test="modulus")), 2)
        np.testing.assert_array_equal(nacre.pattern("a"), pixels)
        self.assertEqual(nacre.key(nacre.pattern("laminate:x:3:2")), nacre.key("laminate:x:3:2"))

    def test_the_area_under_the_curve_is_the_toughness(self):
        result = nacre.simulate("a", fidelity="tiny", test="toughness")
        self.assertIsNone(result["modulus_pa"])
        self.assertEqual(len(result["curves"]), 8)
        areas = [np.trapz(curve["stress_pa"], curve["strain"]) for curve in result["curves"]]
        self.assertAlmostEqual(np.mean(areas) / result["toughness_pa"], 1.0, places=2)
        self.assertEqual(result["curves"][0]["strain"].shape, result["curves"][0]["stress_pa"].shape)

    def test_the_film_is_that_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            told("simulate", PUBLISHED, "--fidelity", "tiny", "--frames", folder, "--frame-count", 6)
            there = nacre.read_film(next(pathlib.Path(folder).glob("*.film")))
        here = nacre.simulate("a", fidelity="tiny", film=6)["film"]
        frames, rows, columns = 6, here["rows"], here["columns"]
        self.assertEqual(here["energy_j_per_m3"].shape, (frames, rows, columns))
        self.assertEqual(here["displacement_m"].shape, (frames, rows + 1, columns + 1, 2))
        self.assertEqual(here["breaks"]["element"].size, here["broken"][-1])
        self.assertGreater(here["broken"][-1], 0)
        # The uppermost nodes follow the grip.
        height = rows * here["element_size_m"]
        top = here["displacement_m"][-1, -1, :, 1]
        np.testing.assert_allclose(top, here["strain"][-1] * height, rtol=0.05)
        for name, value in there.items():
            if isinstance(value, dict):
                for part in value:
                    np.testing.assert_array_equal(here[name][part], value[part], err_msg=name)
            else:
                np.testing.assert_array_equal(here[name], value, err_msg=name)


class Explore(unittest.TestCase):
    def test_the_gamut_is_that_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            out = str(pathlib.Path(folder) / "gamut.csv")
            options = {"budget": 12, "population": 6, "batch": 6, "seed": 3, "fidelity": "tiny"}
            words = [word for name, value in options.items() for word in (f"--{name}", value)]
            there = told("explore", *words, "--out", out)
            written = pathlib.Path(out).read_text()
            here = nacre.explore(**options, out=out)
            self.assertEqual(pathlib.Path(out).read_text(), written)
        names = ("pattern", "modulus_pa", "toughness_pa", "specimens", "toughness_se_pa", "is_on_front")
        columns = {name: here.pop(name) for name in names}
        self.assertEqual(here, there)
        rows = [line.split(",") for line in written.splitlines()[1:]]
        self.assertEqual(list(columns["pattern"]), [row[1] for row in rows])
        self.assertEqual(list(columns["modulus_pa"]), [float(row[3]) for row in rows])
        self.assertEqual(list(columns["toughness_pa"]), [float(row[4]) for row in rows])
        self.assertEqual(columns["is_on_front"].sum(), there["front"])
        self.assertEqual(set(columns["specimens"]), {1})
        self.assertEqual(set(columns["toughness_se_pa"]), {0.0})

    def test_specimens_are_tested_where_they_decide(self):
        start = {"algorithm": "learned", "population": 6, "batch": 6, "seed": 3, "fidelity": "tiny"}
        gamut = nacre.explore(**start, budget=64, specimens=4)
        self.assertEqual(gamut["specimens"].sum(), 64)
        means = gamut["specimens"] > 1
        self.assertTrue(means.any())
        self.assertTrue((gamut["toughness_se_pa"][means] > 0.0).all())


class Sets(unittest.TestCase):
    def test_a_measured_set_is_that_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            lab = folder / "lab.toml"
            lab.write_text('seed = 4\nfidelity = "tiny"\nreplicates = 2\n[noise]\nmodulus = 0.01\n')
            there = told("measure", "--lab", lab, "--out", folder / "there", PUBLISHED, "rigid")
            here = nacre.measure(["a", "rigid"], lab, folder / "here")
            self.assertEqual({**here, "set": ""}, {**there, "set": ""})
            for name in ("measurements.csv",):
                self.assertEqual((folder / "here" / name).read_bytes(), (folder / "there" / name).read_bytes())
            with self.assertRaisesRegex(nacre.InputError, "here"):
                nacre.measure("a", lab, folder / "here")

    def test_a_calibration_is_that_of_the_command_line(self):
        folder = SOURCE / "data/examples/round1"
        with tempfile.TemporaryDirectory() as name:
            out = str(pathlib.Path(name) / "fitted.toml")
            there = told("calibrate", folder, "--fidelity", "tiny", "--budget", 4, "--modulus-budget", 10, "--out", out)
            fitted = nacre.read_parameters(out)
        heard = []
        here = nacre.calibrate(folder, fidelity="tiny", budget=4, modulus_budget=10,
                               progress=lambda share, step: heard.append(share))
        self.assertEqual(here.pop("model"), fitted)
        self.assertEqual(here, there)
        self.assertGreater(here["simulations"], 0)
        self.assertTrue(heard)

    def test_a_diagnosis_is_that_of_the_command_line(self):
        folder = SOURCE / "data/examples/turned"
        there = told("diagnose", folder, "--fidelity", "tiny", "--bootstraps", 1000)
        here = nacre.diagnose(folder, fidelity="tiny", bootstraps=1000)
        self.assertEqual(here, there)
        self.assertTrue(here["candidates"])


class Errors(unittest.TestCase):
    def assert_refused(self, message, call):
        with self.assertRaises(nacre.InputError) as caught:
            call()
        self.assertIn(message, str(caught.exception))
        self.assertIsInstance(caught.exception, ValueError)

    def test_bad_input_is_refused_with_what_was_expected(self):
        self.assert_refused("expected a key (14 hex digits", lambda: nacre.simulate("nonsense"))
        self.assert_refused("pixel [3, 4] = 2: expected 0 (soft) or 1 (rigid)", self.with_a_wrong_pixel)
        self.assert_refused("an array of 19 x 20: expected 20 x 20", lambda: nacre.simulate(np.zeros((19, 20))))
        self.assert_refused("int: expected a text, a path or a numpy array", lambda: nacre.simulate(3))
        self.assert_refused("fidelity fast", lambda: nacre.simulate("a", fidelity="fast"))
        self.assert_refused("specimens 0: expected 1 to 1000", lambda: nacre.simulate("a", specimens=0))
        self.assert_refused("strength_cv 0.5: expected 0 or 0.02 to 0.4", lambda: nacre.simulate("a", strength_cv=0.5))
        self.assert_refused("film 1: expected 2 to 1000", lambda: nacre.simulate("a", film=1))
        self.assert_refused("modulus.e_x_pa = 1: unknown key", lambda: nacre.read_parameters({"modulus": {"e_x_pa": 1.0}}))
        self.assert_refused("modulus.nu_tb", lambda: nacre.read_parameters({"modulus": {"nu_tb": 0.7}}))
        self.assert_refused("no-such.toml", lambda: nacre.simulate("a", params="no-such.toml"))
        self.assert_refused("budget 0: expected 1 to", lambda: nacre.explore(budget=0))
        self.assert_refused("seed -1", lambda: nacre.explore(seed=-1))
        self.assert_refused("specimens: `nsga2` tests one specimen", lambda: nacre.explore(specimens=2))
        alike = {"params": {"toughness": {"strength_cv": 0.0}}, "algorithm": "learned", "specimens": 2}
        self.assert_refused("specimens: without strength_cv", lambda: nacre.explore(**alike))
        self.assert_refused("no-such-set", lambda: nacre.calibrate("no-such-set"))
        self.assert_refused("search: ", lambda: nacre.calibrate(SOURCE / "data/examples/round1", search="luck"))
        self.assert_refused("no-such-set", lambda: nacre.diagnose("no-such-set"))
        self.assert_refused("no-such-run", lambda: nacre.read_run("no-such-run"))
        self.assert_refused("no-such.film", lambda: nacre.read_film("no-such.film"))

    @staticmethod
    def with_a_wrong_pixel():
        pixels = np.zeros((20, 20))
        pixels[3, 4] = 2
        nacre.simulate(pixels)

    def test_a_value_in_another_unit_is_warned_of(self):
        with self.assertWarnsRegex(UserWarning, "modulus.e_vw_pa = 2.6 lies far outside"):
            nacre.read_parameters({"modulus": {"e_vw_pa": 2.6}})

    def test_parameters_survive_the_way_through_a_dict(self):
        whole = nacre.read_parameters({"extension": {"rate_dependence": {"value": [0.4, 20.0]}}})
        self.assertEqual(whole["modulus"], nacre.default_parameters()["modulus"])
        self.assertEqual(nacre.read_parameters(whole), whole)


class Progress(unittest.TestCase):
    def test_the_callback_hears_of_it_in_the_calling_thread(self):
        heard = []
        nacre.simulate(["a", "b"], fidelity="tiny",
                       progress=lambda share, step: heard.append((share, step, threading.current_thread())))
        self.assertEqual(heard[-1][:2], (1.0, "testing"))
        self.assertEqual({thread for _, _, thread in heard}, {threading.current_thread()})
        self.assertEqual([share for share, _, _ in heard], sorted(share for share, _, _ in heard))

    def test_what_the_callback_raises_ends_the_call(self):
        def refuse(share, step):
            raise KeyError(step)

        begun = time.monotonic()
        with self.assertRaises(KeyError):
            nacre.simulate("a", fidelity="tiny", specimens=1000, strength_cv=0.1, progress=refuse)
        self.assertLess(time.monotonic() - begun, 20.0)

    def test_ctrl_c_ends_the_call(self):
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        begun = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            nacre.simulate("a", fidelity="tiny", specimens=1000, strength_cv=0.1)
        timer.join()
        self.assertLess(time.monotonic() - begun, 20.0)
        self.assertGreater(nacre.simulate("a", fidelity="tiny")["toughness_pa"], 0.0)

    def test_other_threads_run_meanwhile(self):
        ticks = []
        ended = threading.Event()

        def tick():
            while not ended.wait(0.01):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        thread.start()
        begun = time.monotonic()
        nacre.simulate("a", fidelity="tiny", test="toughness")
        end = time.monotonic()
        ended.set()
        thread.join()
        self.assertGreater(sum(begun < t < end for t in ticks), 5)


class Examples(unittest.TestCase):
    def test_an_optimiser_of_ones_own_drives_the_testers(self):
        with tempfile.TemporaryDirectory() as folder:
            gamut = pathlib.Path(folder) / "gamut.csv"

            def search(tests):
                done = subprocess.run([sys.executable, SOURCE / "examples/ask_tell.py", NACRE, gamut, str(tests), "tiny"],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                lines = [line.split() for line in done.stdout.splitlines()]
                merits = [float(words[2]) for words in lines]
                self.assertEqual(merits, sorted(merits))
                self.assertGreater(len(merits), 1)
                rows = {row.split(",")[1]: row.split(",") for row in gamut.read_text().splitlines()[1:]}
                _, _, _, modulus, toughness, error, specimens = rows[lines[-1][1]]
                self.assertAlmostEqual(float(modulus) * float(toughness) / 1e15, merits[-1], delta=1e-4)
                self.assertGreater(float(error), 0.0)
                return len(rows)

            self.assertEqual(search(60), 30)
            self.assertEqual(search(100), 50)


class Stubs(unittest.TestCase):
    def test_every_name_has_its_types_and_a_docstring(self):
        stub = ast.parse((pathlib.Path(nacre.__file__).parent / "__init__.pyi").read_text())
        functions = {}
        for node in stub.body:
            if isinstance(node, ast.FunctionDef):
                functions[node.name] = [a.arg for a in node.args.args] + [a.arg for a in node.args.kwonlyargs]
        classes = {node.name for node in stub.body if isinstance(node, ast.ClassDef)}
        public = {name: value for name, value in vars(nacre).items()
                  if not name.startswith("_") and not inspect.ismodule(value)}
        self.assertEqual(set(public), set(functions) | classes)
        for name, names in functions.items():
            signature, doc = public[name].__doc__.split("\n", 1)
            inside = signature[signature.index("(") + 1:signature.rindex(") ->")]
            arguments = [part.split(":")[0].strip() for part in inside.split(",")] if inside else []
            self.assertEqual([a for a in arguments if a != "*"], names, name)
            self.assertIn("Returns", doc, name)
        for name in classes:
            self.assertTrue(public[name].__doc__, name)
            self.assertEqual(public[name].__module__, "nacre")


if __name__ == "__main__":
    sys.exit(not unittest.main(exit=False).result.wasSuccessful())
