"""Do the units keep the rules that no checker looks at (rules.py), and would each rule notice? Every rule finds a defect that is planted
into a good description or archive, and the good ones have none."""

import io
import re
import zipfile

import pytest
import rules


def description(fmu) -> bytes:
    with zipfile.ZipFile(fmu) as archive:
        return archive.read("modelDescription.xml")


@pytest.fixture(scope="module")
def good(request):
    """A unit with inputs."""
    (fmu,) = [path for path in request.config.fmus if path.stem == "crane"] or request.config.fmus[:1]
    return fmu


def test_description(fmu):
    assert rules.description_problems(description(fmu)) == []


def test_archive(fmu):
    assert rules.archive_problems(fmu.read_bytes()) == []


# Rule, what it says, pattern in the description, replacement of its first occurrence.
DEFECTS = [
    ("identifier", "no C identifier", r'modelIdentifier="\w+"', 'modelIdentifier="my-model"'),
    ("identifier", "no C identifier", r'modelIdentifier="\w+"', 'modelIdentifier="double"'),
    ("unique", "variables are called", r'(<ScalarVariable name="([^"]*)".*?<ScalarVariable name=")[^"]*', r"\1\2"),
    ("unique", "value reference", r'valueReference="1"', 'valueReference="0"'),
    ("unique", "Categorys are called", r'(<Category name="([^"]*)".*?<Category name=")[^"]*', r"\1\2"),
    ("unique", "a type and a variable", r'(<SimpleType name="([^"]*)".*?<ScalarVariable name=")[^"]*', r"\1\2"),
    ("bounds", "not within", r'min="0.0" start="[^"]*"', 'min="0.0" start="-1.0"'),
    ("bounds", "is above max", r'min="0.0" start=', 'min="0.0" max="-1.0" start='),
    ("bounds", "not all finite", r' start="[^"]*"', ' start="INF"'),
    ("bounds", "start None of a input", r'(causality="input".*?) start="[^"]*"', r"\1"),
    ("bounds", "of a output", r'(causality="output".*?<Real )', r'\1start="1.0" '),
    ("combinations", "do not go together", r'causality="parameter" variability="\w+"', 'causality="parameter" variability="continuous"'),
    ("combinations", "with initial None", r' initial="calculated"', ""),
    ("combinations", "a continuous Integer", r'(variability="continuous"[^>]*>\s*)<Real [^>]*>', r"\1<Integer/>"),
    ("units", "without a unit", r'(causality="output".*?)unit="m"', r"\1"),
    ("units", "is none of", r'unit="m" ', 'unit="m" displayUnit="furlong" '),
    ("units", "is not defined", r'unit="m" ', 'unit="ell" '),
    ("units", "is not used", r"<UnitDefinitions>", '<UnitDefinitions><Unit name="ell"><BaseUnit m="1"/></Unit>'),
    ("units", "has no exponents", r'<BaseUnit m="1"/?>', "<BaseUnit/>"),
    ("structure", "Outputs differ", r'<Unknown index="\d+" dependencies=""/>', ""),
    ("structure", "depends on everything", r' dependencies=""', ""),
    ("structure", "depends on 1", r' dependencies=""', ' dependencies="1"'),
    ("structure", "InitialUnknowns differ", r"(<InitialUnknowns>\s*)<Unknown [^>]*>", r"\1"),
    ("structure", "depends on an output", r'(<Outputs>\s*<Unknown index="(\d+)".*<InitialUnknowns>\s*<Unknown index="\d+")', r'\1 dependencies="\2"'),
    ("annotations", "has no namespace", r"<ancf14:Derivatives", "<Derivatives"),
    ("capabilities", "serialized but not had", r'canGetAndSetFMUstate="true"', 'canGetAndSetFMUstate="false"'),
    ("capabilities", "is claimed", r'needsExecutionTool="false"', 'needsExecutionTool="true"'),
    ("categories", "no log category", r'<Category name="[^"]*"', '<Category name="logLog"'),
    ("categories", "no log categories", r"<LogCategories>.*</LogCategories>", ""),
    ("experiment", "is not after", r'stopTime="[^"]*"', 'stopTime="-1.0"'),
    ("experiment", "does not fit", r'stepSize="[^"]*"', 'stepSize="0.0"'),
    ("experiment", "no default experiment", r"<DefaultExperiment[^>]*>", ""),
    ("words", "not described", r'(<ScalarVariable [^>]*) description="[^"]*"', r"\1"),
    ("words", "guid", r'guid="\{', 'guid="'),
]


@pytest.mark.parametrize("rule, says, pattern, replacement", DEFECTS, ids=[f"{rule}: {says}" for rule, says, *_ in DEFECTS])
def test_a_defect_is_found(good, rule, says, pattern, replacement):
    text = description(good).decode()
    bad, count = re.subn(pattern, replacement, text, count=1, flags=re.DOTALL)
    assert count == 1 and bad != text, "the defect could not be planted"
    found = [problem for problem in rules.description_problems(bad.encode()) if problem.startswith(f"{rule}: ")]
    assert any(says in problem for problem in found), found


def test_every_rule_has_a_defect():
    assert {rule for rule, *_ in DEFECTS} == {rule.__name__ for rule in rules.RULES}


def packed_again(fmu, change) -> bytes:
    """The archive with its entries as `change` leaves them: it is given and gives a list of [name, bytes, options]."""
    with zipfile.ZipFile(fmu) as archive:
        entries = [[entry.filename, archive.read(entry), {}] for entry in archive.infolist()]
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content, options in change(entries):
            entry = zipfile.ZipInfo(name, options.get("date", (1980, 1, 1, 0, 0, 0)))
            entry.compress_type = options.get("method", zipfile.ZIP_DEFLATED)
            with archive.open(entry, "w", force_zip64=options.get("zip64", False)) as file:
                file.write(content)
    return out.getvalue()


def without(wanted):
    return lambda entries: [entry for entry in entries if entry[0] != wanted]


def replaced(wanted, content):
    return lambda entries: [[name, content if name == wanted else old, options] for name, old, options in entries]


def added(name, **options):
    return lambda entries: [*entries, [name, b"x", options]]


ARCHIVE_DEFECTS = [
    ("name", added("resources/süd.txt")),
    ("name", added("resources\\x.txt")),
    ("name", added("/resources/x.txt")),
    ("name", added("resources/../x.txt")),
    ("zip64", added("resources/x.txt", zip64=True)),
    ("method 12", added("resources/x.txt", method=zipfile.ZIP_BZIP2)),
    ("has the date", added("resources/x.txt", date=(2026, 1, 1, 0, 0, 0))),
    ("has no place", added("x.txt")),
    ("stored twice", added("resources/model.toml")),
    ("modelDescription.xml is missing", without("modelDescription.xml")),
    ("model.png is missing", without("model.png")),
    ("terminalsAndIcons.xml is missing", without("terminalsAndIcons/terminalsAndIcons.xml")),
    ("model.png is something else", replaced("model.png", b"GIF89a")),
    ("index.html is missing", without("documentation/index.html")),
    ("license.txt is missing", without("documentation/licenses/license.txt")),
    ("model.toml is missing", without("resources/model.toml")),
    ("is missing", lambda entries: [entry for entry in entries if not entry[0].startswith("binaries/")]),
]


@pytest.mark.filterwarnings("ignore:Duplicate name")
@pytest.mark.parametrize("says, change", ARCHIVE_DEFECTS, ids=[f"{k}: {says}" for k, (says, _) in enumerate(ARCHIVE_DEFECTS)])
def test_a_defect_of_the_archive_is_found(good, says, change):
    assert rules.archive_problems(packed_again(good, lambda entries: entries)) == []
    found = rules.archive_problems(packed_again(good, change))
    assert any(says in problem for problem in found), found
