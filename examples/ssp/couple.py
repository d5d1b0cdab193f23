"""Writes a system of two or more FMUs as an SSP file, connected terminal by terminal: outputs of one terminal go to the inputs of the other that have the same member
names (`terminalsAndIcons/terminalsAndIcons.xml` inside the FMUs).

    ancf14 pack arm.toml -o arm.fmu
    ancf14 pack forearm.toml -o forearm.fmu
    python couple.py arm.fmu forearm.fmu arm.arm_end=forearm.hand forearm.hand_load=arm.tip -o system.ssp

FMUs of FMI 2.0, since the hosts of SSP 1.0 know no arrays. Needs Python 3.11 or later and no packages.
"""

import argparse
import zipfile
from pathlib import Path
from xml.etree import ElementTree

SSD = "http://ssp-standard.org/SSP1/SystemStructureDescription"
SSC = "http://ssp-standard.org/SSP1/SystemStructureCommon"


class Unit:
    """An FMU as a component: causality and type of its variables, and the members of its terminals."""

    def __init__(self, path: Path):
        self.path, self.name = path, path.stem
        with zipfile.ZipFile(path) as archive:
            description = ElementTree.fromstring(archive.read("modelDescription.xml"))
            version = description.get("fmiVersion")
            if version != "2.0":
                raise SystemExit(f"{path} is an FMU of FMI {version}, and SSP 1.0 takes FMI 2.0: pack it again with --fmi 2")
            terminals = ElementTree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
        self.stop = float(description.find("DefaultExperiment").get("stopTime"))
        variables = description.find("ModelVariables")
        self.causality = {variable.get("name"): variable.get("causality") for variable in variables}
        # The first element of a variable is its type.
        self.type = {variable.get("name"): variable[0].tag for variable in variables}
        self.terminals = {
            terminal.get("name"): {member.get("memberName"): member.get("variableName") for member in terminal}
            for terminal in terminals.iter("Terminal")
        }

    def members(self, terminal: str, causality: str) -> dict[str, str]:
        """Names of variables of a terminal, by the names of the members."""
        if terminal not in self.terminals:
            raise SystemExit(f"{self.path} has no terminal {terminal}; it has {', '.join(self.terminals)}")
        members = self.terminals[terminal]
        return {member: name for member, name in members.items() if self.causality[name] == causality}


def unique(units: list[Unit]) -> dict[str, Unit]:
    """The units by their names."""
    named = {}
    for unit in units:
        if unit.name in named:
            raise SystemExit(f"{named[unit.name].path} and {unit.path} have the same name {unit.name}: rename one of the files")
        named[unit.name] = unit
    return named


def connections(units: dict[str, Unit], pairs: list[str]):
    """Names of output and input, each with its unit, of all pairs `UNIT.TERMINAL=UNIT.TERMINAL`."""
    for pair in pairs:
        ends = [tuple(side.split(".", 1)) for side in pair.split("=", 1)]
        if [len(end) for end in ends] != [2, 2]:
            raise SystemExit(f"{pair} is not a connection: write UNIT.TERMINAL=UNIT.TERMINAL, outputs first")
        (source, outlet), (target, inlet) = ends
        for name in (source, target):
            if name not in units:
                raise SystemExit(f"{pair}: no FMU is named {name}; the FMUs are {', '.join(units)}")
        outputs, inputs = units[source].members(outlet, "output"), units[target].members(inlet, "input")
        missing = [member for member in inputs if member not in outputs]
        if missing:
            raise SystemExit(f"{pair}: {source}.{outlet} has no output {', '.join(missing)}")
        for member, name in inputs.items():
            yield source, outputs[member], target, name


def description(units: dict[str, Unit], wires: list[tuple[str, str, str, str]]) -> bytes:
    """The text of SystemStructure.ssd."""
    ElementTree.register_namespace("ssd", SSD)
    ElementTree.register_namespace("ssc", SSC)
    root = ElementTree.Element(f"{{{SSD}}}SystemStructureDescription", version="1.0", name="System")
    system = ElementTree.SubElement(root, f"{{{SSD}}}System", name="system")
    elements = ElementTree.SubElement(system, f"{{{SSD}}}Elements")
    for unit in units.values():
        attributes = {"name": unit.name, "source": f"resources/{unit.path.name}", "type": "application/x-fmu-sharedlibrary"}
        component = ElementTree.SubElement(elements, f"{{{SSD}}}Component", attributes)
        connectors = ElementTree.SubElement(component, f"{{{SSD}}}Connectors")
        for name, causality in unit.causality.items():
            if causality in ("input", "output"):
                connector = ElementTree.SubElement(connectors, f"{{{SSD}}}Connector", name=name, kind=causality)
                ElementTree.SubElement(connector, f"{{{SSC}}}{unit.type[name]}")
    drawn = ElementTree.SubElement(system, f"{{{SSD}}}Connections")
    for source, output, target, name in wires:
        ends = {"startElement": source, "startConnector": output, "endElement": target, "endConnector": name}
        ElementTree.SubElement(drawn, f"{{{SSD}}}Connection", ends)
    stop = max(unit.stop for unit in units.values())
    ElementTree.SubElement(root, f"{{{SSD}}}DefaultExperiment", startTime="0", stopTime=str(stop))
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)


def main():
    parser = argparse.ArgumentParser(description="Connects FMUs terminal by terminal and writes an SSP file.")
    parser.add_argument("words", nargs="+", help="FMUs, and connections UNIT.TERMINAL=UNIT.TERMINAL from outputs to inputs")
    parser.add_argument("-o", "--output", type=Path, required=True)
    words = parser.parse_args()
    units = unique([Unit(Path(word)) for word in words.words if word.endswith(".fmu")])
    wires = list(connections(units, [word for word in words.words if not word.endswith(".fmu")]))
    with zipfile.ZipFile(words.output, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("SystemStructure.ssd", description(units, wires))
        for unit in units.values():
            archive.write(unit.path, f"resources/{unit.path.name}")
    print(f"{words.output}: {len(units)} FMUs, {len(wires)} connections")


if __name__ == "__main__":
    main()
