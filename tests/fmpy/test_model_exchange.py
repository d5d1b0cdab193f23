"""Do solvers of hosts meet the exact motion of the small FMU in Model Exchange, for both versions of the standard? The exact one is a matrix exponential of the matrices in
the FMU, and the FMU itself in co-simulation takes its steps so."""

import tomllib
import zipfile

import casadi
import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu

from conftest import run
from test_small import ARM, INPUT, OUTPUT

STOP, JUMP, STEP = 0.4, 0.2, 1e-3


@pytest.fixture(scope="module", params=["2", "3"])
def small(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp(f"exchange{request.param}")
    (folder / "arm.toml").write_text(ARM)
    wanted = ["--inputs", INPUT, "--outputs", OUTPUT, "--order", "4"]
    run("reduce", folder / "arm.toml", *wanted, "--fmi", request.param, "-o", folder / "small.fmu")
    return folder / "small.fmu"


def system(small):
    with zipfile.ZipFile(small) as archive:
        return tomllib.loads(archive.read("resources/linear.toml").decode())


def exponential(matrix):
    """The sum of its series, for a share of the matrix so small that ten terms are exact, and squared."""
    halvings = max(0, int(np.ceil(np.log2(np.linalg.norm(matrix, 1) + 1))) + 8)
    small, total, term = matrix / 2.0**halvings, np.eye(len(matrix)), np.eye(len(matrix))
    for k in range(1, 11):
        term = term @ small / k
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


def table(times, forces):
    signal = np.zeros(len(times), dtype=[("time", float), (INPUT, float)])
    signal["time"], signal[INPUT] = times, forces
    return signal


# FMPy 0.3.32 holds inputs between two points of its output: it meets the exact motion where inputs are constant, and may jump.
CONSTANT = table([0, STOP], [5, 5])
JUMPS = table([0, JUMP, JUMP, STOP], [5, 5, 3, 3])


def exact(small, jumps):
    """The output every millisecond: state and force as one linear system."""
    own = system(small)
    a, b, c = (np.array(own[key]) for key in "abc")
    order = len(a)
    whole = np.zeros((order + 1, order + 1))
    whole[:order, :order], whole[:order, order] = a, b[:, 0]
    step = exponential(whole * STEP)
    state, found = np.zeros(order + 1), []
    for number in range(round(STOP / STEP) + 1):
        state[order] = 2 if jumps and number >= round(JUMP / STEP) else 4
        found.append(own["output"][0]["value"] + c[0] @ state[:order])
        state = step @ state
    return np.array(found)


def simulated(small, kind, force, interval=STEP, **options):
    result = simulate_fmu(
        str(small), start_time=0.0, stop_time=STOP, output_interval=interval, input=force, output=[OUTPUT], fmi_type=kind, record_events=False, **options
    )[:: round(STEP / interval)]
    assert np.allclose(result["time"], np.linspace(0, STOP, round(STOP / STEP) + 1))
    return np.asarray(result[OUTPUT])


@pytest.mark.parametrize("jumps", [False, True])
def test_cvode_meets_the_exact_motion(small, jumps):
    expected = exact(small, jumps)
    moved = np.ptp(expected)
    assert 0.005 < moved < 0.01
    error = np.max(np.abs(simulated(small, "ModelExchange", JUMPS if jumps else CONSTANT, relative_tolerance=1e-9) - expected)) / moved
    print(f"CVode: {error:.1e} of the motion")
    # 1e-9 of the nominal position, 1 m, in each of some thousand steps, is 1e-6 m at worst: 1e-4 of the motion.
    assert error < 1e-4


def test_co_simulation_takes_the_same_motion(small):
    # Round-off of 400 steps.
    assert np.max(np.abs(simulated(small, "CoSimulation", CONSTANT) - exact(small, jumps=False))) < 1e-12


def test_euler_is_of_first_order(small):
    expected = exact(small, jumps=True)
    errors = [np.max(np.abs(simulated(small, "ModelExchange", JUMPS, step, solver="Euler", step_size=step) - expected)) for step in (4e-5, 2e-5)]
    print(f"Euler: {errors}")
    # The error of second order is a few percent of that of first order.
    assert errors[0] / errors[1] == pytest.approx(2, rel=0.05)


def test_states_begin_where_the_host_wants(small):
    """A state that begins at 1e-3, without a change of the force: the free motion."""
    own = system(small)
    a, c = np.array(own["a"]), np.array(own["c"])
    name = "state[1]" if read_model_description(str(small)).fmiVersion == "2.0" else "state"
    start = 1e-3 if name == "state[1]" else [1e-3, 0, 0, 0]
    free = [own["output"][0]["value"] + c[0] @ exponential(a * time) @ [1e-3, 0, 0, 0] for time in np.linspace(0, 0.1, 11)]
    for kind in ["ModelExchange", "CoSimulation"]:
        result = simulate_fmu(
            str(small), start_time=0.0, stop_time=0.1, output_interval=1e-2, output=[OUTPUT], fmi_type=kind, start_values={name: start}, relative_tolerance=1e-9, record_events=False
        )
        # The same bound for 100 steps.
        assert np.max(np.abs(result[OUTPUT] - free)) < 1e-7


def test_casadi_reads_the_matrices(small, tmp_path):
    """CasADi's importer takes the FMU for a model: its Jacobian is that of the matrices, through the directional derivatives."""
    if read_model_description(str(small)).fmiVersion != "2.0":
        pytest.skip("CasADi 3.8.2 reads no arrays")
    own = system(small)
    model = casadi.DaeBuilder("small", str(extract(small, tmp_path)))
    rate = model.create("rate", ["x", "u"], ["ode"])
    jacobian = rate.jacobian()
    count = len(own["a"])
    of_state, of_input = jacobian(np.zeros(count), own["input"][0]["value"], np.zeros(count))[:2]
    # CasADi scales its seeds, and scales back.
    assert np.allclose(np.array(of_state), np.array(own["a"]), rtol=1e-14, atol=0)
    assert np.allclose(np.array(of_input), np.array(own["b"]), rtol=1e-14, atol=0)
