"""What no checker looks at, or hardly any: rules of FMI 2.0 and of good manners, for modelDescription.xml and for the archive.

Each rule is a function that yields the problems that it finds, as sentences.
"""

import re
from io import BytesIO
from zipfile import ZipFile

from lxml import etree

KEYWORDS = set(
    "auto break case char const continue default do double else enum extern float for goto if inline int long register restrict return short "
    "signed sizeof static struct switch typedef union unsigned void volatile while".split()
)

# Variables without a dimension, by the end of their names; everything else that is Real needs a unit, but for names without a dot: those are
# the file's own parameters.
DIMENSIONLESS = re.compile(r"(^[^.]+|quaternion|strain|axis2?|y_axis|poisson|drag|added_mass|damping_ratios|tolerance|accuracy|spectral_radius)(\[\d+\])?$")

STANDARD_CATEGORIES = {
    "logEvents", "logSingularLinearSystems", "logNonlinearSystems", "logDynamicStateSelection", "logStatusWarning", "logStatusDiscard",
    "logStatusError", "logStatusFatal", "logStatusPending", "logAll",
}  # fmt: skip

# Causality and variability that FMI 2.0.4 allows together (section 2.2.7), with the `initial` that this unit gives.
COMBINATIONS = {
    ("parameter", "fixed"): "exact", ("parameter", "tunable"): "exact",
    ("calculatedParameter", "fixed"): "calculated", ("calculatedParameter", "tunable"): "calculated",
    ("input", "discrete"): None, ("input", "continuous"): None,
    ("output", "discrete"): "calculated", ("output", "continuous"): "calculated",
    ("local", "continuous"): "exact",
    ("independent", "continuous"): None,
}  # fmt: skip


def variables(root):
    return root.findall("ModelVariables/ScalarVariable")


def number_of_state(variable):
    """The index of the state whose derivative it is; none: it is no derivative."""
    return variable[0].get("derivative")


def is_state(variable):
    return variable.get("causality") == "local" and number_of_state(variable) is None


def repeated(names):
    return sorted({name for name in names if names.count(name) > 1})


def identifier(root):
    """The modelIdentifier is a C identifier: it is a file name and a prefix of C functions."""
    name = root.find("CoSimulation").get("modelIdentifier")
    if not re.fullmatch("[A-Za-z_][A-Za-z0-9_]*", name, flags=re.ASCII) or name in KEYWORDS:
        yield f"modelIdentifier {name!r} is no C identifier"


def unique(root):
    """Names of variables, types, units, categories; value references of one type."""
    for name in repeated([variable.get("name") for variable in variables(root)]):
        yield f"two variables are called {name}"
    for pair in repeated([(variable[0].tag, variable.get("valueReference")) for variable in variables(root)]):
        yield f"two variables have the value reference {pair}"
    for tag in ["Unit", "SimpleType", "Category"]:
        for name in repeated([element.get("name") for element in root.iter(tag)]):
            yield f"two {tag}s are called {name}"
    types = {element.get("name") for element in root.iter("SimpleType")}
    for name in sorted(types & {variable.get("name") for variable in variables(root)}):
        yield f"a type and a variable are called {name}"


def bounds(root):
    """min <= start <= max, all finite numbers; a start where, and only where, something can be set."""
    for variable in variables(root):
        name, number = variable.get("name"), variable[0]
        values = {key: float(number.get(key)) for key in ["min", "start", "max"] if number.get(key) is not None}
        low, high = values.get("min", float("-inf")), values.get("max", float("inf"))
        if not all(abs(value) < float("inf") for value in values.values()):
            yield f"{name}: {values} are not all finite"
        if not low <= high:
            yield f"{name}: min {low} is above max {high}"
        if "start" in values and not low <= values["start"] <= high:
            yield f"{name}: start {values['start']} is not within {low} to {high}"
        if ("start" in values) != (variable.get("causality") in ("parameter", "input") or is_state(variable)):
            yield f"{name}: start {values.get('start')} of a {variable.get('causality')}"


def combinations(root):
    """Causality, variability and initial are said, and go together."""
    for variable in variables(root):
        kind = variable.get("causality"), variable.get("variability")
        if kind not in COMBINATIONS:
            yield f"{variable.get('name')}: {kind} do not go together"
        elif variable.get("initial") != ("calculated" if number_of_state(variable) else COMBINATIONS[kind]):
            yield f"{variable.get('name')}: {kind} with initial {variable.get('initial')}"
        if variable[0].tag != "Real" and variable.get("variability") == "continuous":
            yield f"{variable.get('name')}: a continuous {variable[0].tag}"
    if sum(variable.get("causality") == "independent" for variable in variables(root)) > 1:
        yield "there are two independent variables"


def units(root):
    """Every unit in use is defined, by exponents, and no other; a display unit belongs to its unit; only what has no dimension has none."""
    defined = {unit.get("name"): unit for unit in root.iter("Unit")}
    used = set()
    for variable in variables(root):
        number, name = variable[0], variable.get("name")
        if number.tag != "Real":
            continue
        unit = number.get("unit")
        used.add(unit)
        if unit is None and not DIMENSIONLESS.search(name):
            yield f"{name}: a Real without a unit"
        shown = {display.get("name") for display in defined[unit].iter("DisplayUnit")} if unit in defined else set()
        if number.get("displayUnit") not in shown | {None}:
            yield f"{name}: display unit {number.get('displayUnit')} is none of {unit}"
        declared = next((t for t in root.iter("SimpleType") if t.get("name") == number.get("declaredType")), None)
        if number.get("declaredType") is not None and declared is None:
            yield f"{name}: type {number.get('declaredType')} is not defined"
    for element in root.iter("SimpleType"):
        used.add(element[0].get("unit"))
    for unit in sorted((used - {None}) ^ defined.keys()):
        yield f"unit {unit} is {'not used' if unit in defined else 'not defined'}"
    for name, unit in defined.items():
        base = unit.find("BaseUnit")
        if base is None or (not base.attrib and name not in ("1", "-")):
            yield f"unit {name} has no exponents"


def structure(root):
    """Outputs are the outputs, each depending on nothing, but on inputs and states in Model Exchange; InitialUnknowns are what is calculated at the start, in order."""
    places = {
        "Outputs": [k for k, variable in enumerate(variables(root), start=1) if variable.get("causality") == "output"],
        "Derivatives": [k for k, variable in enumerate(variables(root), start=1) if number_of_state(variable)],
        "InitialUnknowns": [k for k, variable in enumerate(variables(root), start=1) if variable.get("initial") == "calculated"],
    }
    for group, wanted in places.items():
        found = [int(unknown.get("index")) for unknown in root.findall(f"ModelStructure/{group}/Unknown")]
        if found != wanted:
            yield f"{group} differ from the variables at {sorted(set(found) ^ set(wanted)) or 'their order'}"
    states = {k for k, variable in enumerate(variables(root), start=1) if is_state(variable)}
    if states != {int(number_of_state(variable)) for variable in variables(root) if number_of_state(variable)}:
        yield "not every state has a derivative"
    given = states | {k for k, variable in enumerate(variables(root), start=1) if variable.get("causality") == "input"} if states else set()
    for unknown in root.findall("ModelStructure/Outputs/Unknown") + root.findall("ModelStructure/Derivatives/Unknown"):
        if "dependencies" not in unknown.attrib or not set(map(int, unknown.get("dependencies").split())) <= given:
            yield f"unknown {unknown.get('index')} depends on {unknown.get('dependencies', 'everything')}"
    outputs = set(places["Outputs"])
    for unknown in root.findall("ModelStructure/InitialUnknowns/Unknown"):
        if outputs & set(map(int, unknown.get("dependencies", "").split())):
            yield f"initial unknown {unknown.get('index')} depends on an output"


def annotations(root):
    """Elements of a vendor have a namespace: VDMCheck2 takes those without one for elements of the standard, and
    gives no verdict."""
    for tool in root.findall("VendorAnnotations/Tool"):
        for element in tool:
            if not element.tag.startswith("{"):
                yield f"the element {element.tag} of {tool.get('name')} has no namespace"


def capabilities(root):
    """What is claimed goes together, and what is claimed of this product is claimed always."""
    unit = root.find("CoSimulation")

    def claims(name):
        return unit.get(name) == "true"

    if claims("canSerializeFMUstate") and not claims("canGetAndSetFMUstate"):
        yield "states can be serialized but not had"
    for name in ["canHandleVariableCommunicationStepSize", "canGetAndSetFMUstate", "canNotUseMemoryManagementFunctions"]:
        if not claims(name):
            yield f"{name} is not claimed"
    for name in ["needsExecutionTool", "canBeInstantiatedOnlyOncePerProcess", "canRunAsynchronuously"]:
        if claims(name):
            yield f"{name} is claimed"
    if (root.find("ModelExchange") is not None) != any(map(is_state, variables(root))):
        yield "Model Exchange is claimed without states, or states without Model Exchange"
    if root.find("ModelExchange") is not None and root.find("ModelExchange").get("modelIdentifier") != unit.get("modelIdentifier"):
        yield "the two kinds have two libraries"


def categories(root):
    """The standard's names of log categories."""
    names = [category.get("name") for category in root.iter("Category")]
    if not names:
        yield "there are no log categories"
    for name in sorted(set(names) - STANDARD_CATEGORIES):
        yield f"{name} is no log category of the standard"


def experiment(root):
    """start < stop, 0 < step <= stop - start."""
    found = root.find("DefaultExperiment")
    if found is None:
        yield "there is no default experiment"
        return
    start, stop, step = (float(found.get(key, "nan")) for key in ["startTime", "stopTime", "stepSize"])
    if not start < stop:
        yield f"stop time {stop} is not after start time {start}"
    if not 0 < step <= stop - start:
        yield f"step {step} does not fit between {start} and {stop}"


def words(root):
    """Everything says what it is; the root names version, tool and a guid."""
    for variable in variables(root):
        if not (variable.get("description") or "").strip():
            yield f"{variable.get('name')} is not described"
    if root.get("fmiVersion") != "2.0" or not root.get("generationTool"):
        yield "version or tool are missing"
    if not re.fullmatch(r"\{[0-9a-f-]{36}\}", root.get("guid") or ""):
        yield f"guid {root.get('guid')} is none"


RULES = [identifier, unique, bounds, combinations, units, structure, annotations, capabilities, categories, experiment, words]


def description_problems(xml: bytes) -> list[str]:
    root = etree.fromstring(xml)
    return [f"{rule.__name__}: {problem}" for rule in RULES for problem in rule(root)]


def archive_problems(data: bytes) -> list[str]:
    """Names, dates and formats that every unzip reads, and that each file is where the standard wants it and is what its name says."""
    archive = ZipFile(BytesIO(data))
    entries = archive.infolist()
    names = [entry.orig_filename for entry in entries]
    problems = [f"{name} is stored twice" for name in repeated(names)]
    for entry, name in zip(entries, names):
        if not name.isascii() or "\\" in name or name.startswith("/") or ".." in name.split("/"):
            problems.append(f"name {name!r}")
        # 45 is zip64's; field 1 of the extra data too.
        if entry.extract_version >= 45 or entry.extra[:2] == b"\x01\x00":
            problems.append(f"{name} needs zip64")
        if entry.compress_type not in (0, 8):
            problems.append(f"{name} is compressed by method {entry.compress_type}")
        if entry.date_time != (1980, 1, 1, 0, 0, 0):
            problems.append(f"{name} has the date {entry.date_time}")
    if b"PK\x06\x06" in data[-4096:]:
        problems.append("the directory needs zip64")
    if "modelDescription.xml" not in names:
        return [*problems, "modelDescription.xml is missing"]
    identifier = etree.fromstring(archive.read("modelDescription.xml")).find("CoSimulation").get("modelIdentifier")
    model = "linear" if "resources/linear.toml" in names else "model"
    starts = {
        "model.png": b"\x89PNG\r\n\x1a\n",
        "terminalsAndIcons/terminalsAndIcons.xml": b"<?xml",
        "documentation/index.html": b"<!DOCTYPE html>",
        "documentation/licenses/license.txt": b"Licences",
        f"resources/{model}.toml": b"",
        f"binaries/linux64/{identifier}.so": b"\x7fELF",
    }
    for name, start in starts.items():
        if name not in names:
            problems.append(f"{name} is missing")
        elif not archive.read(name).startswith(start):
            problems.append(f"{name} is something else")
    for name in sorted(set(names) - {*starts, "modelDescription.xml"}):
        if not name.startswith(("binaries/", "resources/")):
            problems.append(f"{name} has no place in an FMU")
    return problems
