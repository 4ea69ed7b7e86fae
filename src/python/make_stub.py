"""Writes the type stub of the module: a template, its parameters from the module itself.

make_stub.py FOLDER_OF_THE_PACKAGE TEMPLATE OUTPUT
"""
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import scotopic  # noqa: E402

NUMBERS = {"X", "CDM2", "DEG", "YEARS", "EV", "DE00", "NS"}


def kind(parameter):
    if parameter.takes in NUMBERS or parameter.takes.startswith("INT"):
        return "_Number"
    if parameter.name == "acuity":
        return "bool | str"
    return "str | _Number | _Sequence"


text = open(sys.argv[2], encoding="utf-8").read()
lines = [f"    {p.name}: {kind(p)} | None = ...," for p in scotopic.parameters()]
for indent in ("    ", ""):
    text = text.replace(f"{indent}    # PARAMETERS\n", "".join(indent + line + "\n" for line in lines))
open(sys.argv[3], "w", encoding="utf-8").write(text)
