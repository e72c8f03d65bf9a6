"""Models of our own, as tables, and their text in XML, JSON and ZIP."""

from __future__ import annotations

import json
import zipfile
from io import BytesIO
from typing import Any
from xml.sax.saxutils import escape, quoteattr

ROLLING = "rolling_bearing_with_detailed_geometry"


def part(number: int, kind: str, name: str = "", **attributes: Any) -> dict[str, Any]:
    """A component; of each attribute (unit, value), or a word."""
    given = {key: each if isinstance(each, tuple) else ("none", each) for key, each in attributes.items()}
    return {"id": number, "type": kind, "name": name, "attributes": given}


def b218(version: str = "1.4", contacts: bool = True, mirrored: bool = False) -> dict[str, Any]:
    """A shaft on one B218 under 17.8 kN, in units of all kinds.

    Args:
        contacts: whether its balls have their contacts already.
        mirrored: whether the bearing's u points against the shaft's.
    """
    axis = {"u_axis_vector": ("mm", [-1.0, 0.0, 0.0]), "w_axis_vector": ("mm", [0.0, 0.0, 1.0])} if mirrored else {}
    materials = {"elastic_modulus": ("N / mm^2", 208000), "poisson_ratio": ("", 0.3), "density": ("kg / dm^3", 7.8)}
    new = version == "2.0.0"
    components = [
        part(1, "gear_unit", "unit"),
        part(2, "gear_casing", "casing"),
        part(3, "shaft", 'spindle "A" & co', rotational_speed=("1 / min", 10000)),
        part(4, "shaft_section", u_coordinate_on_shaft=("mm", -20), length=("m", 0.1),
             outer_diameter_begin=("mm", 90), outer_diameter_end=("mm", 90)),
        part(5, "external_load", "thrust", u_coordinate_on_shaft=("mm", 50), force_u_direction=("kN", 17.8)),
        part(6, ROLLING, "B218 [6]", bearing_type="angular_contact_ball_bearing", inner_diameter=("mm", 90),
             outer_diameter=("mm", 160), width=("mm", 30), u_coordinate_on_shaft_inner_side=("mm", 12),
             axial_force_absorption="negative" if mirrored else "positive", number_of_bearing_rows=("none", 1), **axis),
        part(7, "rolling_bearing_row", number_of_rolling_elements=("none", 16), pressure_angle=("deg", 40),
             raceway_radius_of_inner_ring=("mum", 11628.1), raceway_radius_of_outer_ring=("mm", 11.6281),
             **{"reference_diameter_rolling_bearing" if new else "reference_diameter": ("mm", 125.26)}),
        part(8, "material", "100Cr6", **materials, thermal_expansion_coefficient_plus=("1e-6 / C", 12)),
    ]  # fmt: skip
    relations: list[tuple[str, int, dict[str, int]]] = [
        ("assembly", 0, {"assembly": 1, "part": 3}), ("assembly", 0, {"assembly": 3, "part": 4}),
        ("assembly", 0, {"assembly": 3, "part": 5}), ("side", 0, {"assembly": 6, "inner_part": 3, "outer_part": 2}),
        ("ordered_assembly", 1, {"assembly": 6, "part": 7}), ("reference", 0, {"origin": 6, "referenced": 8}),
    ]  # fmt: skip
    for ball in range(16):
        number = 100 + ball
        turned = (180.0 if mirrored else 0.0) - (22.5 if mirrored else -22.5) * ball
        components.append(
            part(number, "rolling_element", diameter_of_rolling_element=("mm", 22.225),
                 angular_position_around_u=("deg", turned % 360.0))
        )  # fmt: skip
        relations.append(("ordered_assembly", ball + 1, {"assembly": 7, "part": number}))
        relations.append(("reference", 0, {"origin": number, "referenced": 8}))
        for side, at in (("inner", 200), ("outer", 300)) if contacts else ():
            one = part(at + ball, "rolling_element_contact", rolling_element_contact_type=f"{side}_raceway_contact")
            components.append(one)
            relations.append(("assembly", 0, {"assembly": number, "part": at + ball}))
    return {"version": version, "components": components, "relations": relations, "load_cases": []}


def gearbox() -> dict[str, Any]:
    """A shaft with a gear on a catalogue bearing without balls, a concept bearing and a roller bearing; a second one on
    a bearing that is found by its designation."""
    catalogue = "rolling_bearing_with_catalog_geometry"
    components = [
        part(2, "gear_casing"), part(3, "shaft", "input"), part(4, "shaft", "output"),
        part(5, "cylindrical_gear", "z1"),
        part(10, catalogue, "left", bearing_type="radial_grooved_ball_bearing", inner_diameter=("mm", 50),
             outer_diameter=("mm", 90), catalogue_designation="6210-2Z", axial_force_absorption="both_directions",
             u_coordinate_on_shaft_inner_side=("mm", 0)),
        part(11, "concept_bearing", "spring"),
        part(12, catalogue, "rollers", bearing_type="radial_tapered_roller_bearing"),
        part(13, catalogue, "right", bearing_type="angular_contact_ball_bearing", catalogue_designation="7210C",
             axial_force_absorption="negative", u_coordinate_on_shaft_inner_side=("mm", 40), preload_force=("N", 500)),
        part(14, catalogue, "between", bearing_type="four_point_contact_ball_bearing"),
    ]  # fmt: skip
    relations = [("assembly", 0, {"assembly": 3, "part": 5})]
    for bearing, inner, outer in ((10, 3, 2), (11, 3, 2), (12, 3, 2), (13, 4, 2), (14, 3, 4)):
        relations.append(("side", 0, {"assembly": bearing, "inner_part": inner, "outer_part": outer}))
    cases = [{1: {}, 3: {"rotational_speed": ("1 / min", speed)}} for speed in (1000, 2000)]
    components.append(part(1, "gear_unit"))
    return {"version": "1.4", "components": components, "relations": relations, "load_cases": cases}


def xml(model: dict[str, Any], newline: str = "\n") -> bytes:
    """As XML, the elements on lines of their own."""
    kinds = {each["id"]: each["type"] for each in model["components"]}

    def attribute(name: str, unit: str, value: Any) -> str:
        inner = escape(str(value))
        if isinstance(value, list):
            inner = "<array>" + "".join(f"<c>{each}</c>" for each in value) + "</array>"
        return f'<attribute id="{name}" unit="{unit}">{inner}</attribute>'

    lines = ['<?xml version="1.0" encoding="UTF-8" standalone="no"?>', "<!-- our own -->"]
    head = 'applicationId="test" applicationVersion="1" date="2026-01-01T00:00:00+00:00"'
    lines += [f'<model {head} version="{model["version"]}">', "  <relations>"]
    for number, (kind, order, parts) in enumerate(model["relations"], 1):
        lines.append(f'    <relation id="{number}"{f" order={chr(34)}{order}{chr(34)}" * bool(order)} type="{kind}">')
        lines += [f'      <ref hint="{kinds[at]}" id="{at}" role="{role}"/>' for role, at in parts.items()]
        lines.append("    </relation>")
    lines += ["  </relations>", "  <components>"]
    for each in model["components"]:
        opened = f'    <component id="{each["id"]}" name={quoteattr(each["name"])} type="{each["type"]}"'
        inner = [f"      {attribute(name, *given)}" for name, given in each["attributes"].items()]
        lines += [f"{opened}>", *inner, "    </component>"] if inner else [f"{opened} />"]
    lines.append("  </components>")
    if model["load_cases"]:
        lines.append('  <load_spectrum id="1">')
        for number, changed in enumerate(model["load_cases"], 1):
            lines.append(f'    <load_case id="{number}">')
            for at, given in changed.items():
                inner = [f"        {attribute(name, *one)}" for name, one in given.items()]
                lines += [f'      <component id="{at}" type="{kinds[at]}">', *inner, "      </component>"]
            lines.append("    </load_case>")
        lines.append("  </load_spectrum>")
    return newline.join([*lines, "</model>", ""]).encode()


def as_json(model: dict[str, Any]) -> dict[str, Any]:
    """As the tables of JSON."""

    def listed(given: dict[str, Any]) -> list[dict[str, Any]]:
        kinds = {list: "floating_point_array", str: "enum", int: "integer", float: "floating_point"}
        return [{"id": name, "unit": unit, kinds[type(value)]: value} for name, (unit, value) in given.items()]

    relations = [
        {"id": number, "type": kind, **({"order": order} if order else {}),
         "refs": [{"id": at, "role": role} for role, at in parts.items()]}
        for number, (kind, order, parts) in enumerate(model["relations"], 1)
    ]  # fmt: skip
    components = [{**each, "attributes": listed(each["attributes"])} for each in model["components"]]
    root = {"version": model["version"], "applicationId": "test", "applicationVersion": "1",
            "date": "2026-01-01T00:00:00+00:00", "relations": relations, "components": components}  # fmt: skip
    if model["load_cases"]:
        cases = [
            {"id": number, "components": [{"id": at, "attributes": listed(given)} for at, given in changed.items()]}
            for number, changed in enumerate(model["load_cases"], 1)
        ]
        root["load_spectrum"] = {"id": 1, "load_cases": cases}
    return {"model": root}


def json_text(model: dict[str, Any]) -> bytes:
    """As JSON, its parts on lines of their own."""
    return json.dumps(as_json(model), indent=2, ensure_ascii=False).encode()


def zipped(data: bytes, name: str = "model.rexs") -> bytes:
    """In a ZIP, beside another file."""
    made = BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as folder:
        folder.writestr(zipfile.ZipInfo("readme.txt"), "not a model")
        folder.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)
    return made.getvalue()
