"""Runs the notebooks and writes each as Markdown with its pictures: render.py SOURCE FOLDER."""

import pathlib
import re
import shutil
import sys

import nbformat
from nbclient import NotebookClient
from nbconvert import MarkdownExporter
from nbconvert.preprocessors import TagRemovePreprocessor


def run(path, source):
    """The notebook with its outputs; its working directory is the repository, where models/ is."""
    notebook = nbformat.read(path, as_version=4)
    NotebookClient(notebook, timeout=200, kernel_name="python3", resources={"metadata": {"path": str(source)}}).execute()
    return notebook


def markdown(notebook, name):
    """Its text, and its pictures by name."""
    remover = TagRemovePreprocessor(remove_all_outputs_tags={"remove-output"}, enabled=True)
    notebook, _ = remover.preprocess(notebook, {})
    for cell in notebook.cells:  # of a progress that is done nothing is left
        if cell.cell_type == "code":
            cell.outputs = [o for o in cell.outputs if o.get("data") != {"text/plain": ""}]
    resources = {"output_files_dir": f"{name}_files", "unique_key": name}
    text, resources = MarkdownExporter().from_notebook_node(notebook, resources)
    return re.sub(r"[ \t]+\n", "\n", re.sub(r"\n{3,}", "\n\n", text)).strip() + "\n", resources.get("outputs", {})


def main():
    source, folder = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
    shutil.rmtree(folder, ignore_errors=True)
    for path in sorted((source / "python" / "notebooks").glob("*.ipynb")):
        text, pictures = markdown(run(path, source), path.stem)
        (folder / f"{path.stem}_files").mkdir(parents=True)
        (folder / f"{path.stem}.md").write_text(text)
        for name, data in pictures.items():
            (folder / name).write_bytes(data)


if __name__ == "__main__":
    main()
