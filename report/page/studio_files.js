// Files in and out: nothing is written but what the browser downloads.

export function download(name, text, type = "text/plain") {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], {type}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// What a shared file holds.
export function shared(design) {
  return `${JSON.stringify({corank: "studio", ...design.now}, null, 1)}\n`;
}

const most = 1 << 20; // bytes of a model

// A model of some files: {file, text, loops …}. Throws an Error with what was expected.
export async function modelOfFiles(files) {
  const list = [...files];
  const ending = (end) => list.find(({name}) => name.endsWith(end));
  const main = ending(".json") ?? ending(".urdf") ?? ending(".world") ?? ending(".cuik");
  if (!main) throw new Error("expected a file that ends in .cuik, .world, .urdf (with its .loops) or .json, from Share");
  if (list.some(({size}) => size > most)) throw new Error("a file of more than a megabyte is no model");
  const text = await main.text();
  if (main.name.endsWith(".json")) {
    const design = JSON.parse(text);
    if (design.corank !== "studio" || typeof design.text !== "string") throw new Error(`${main.name} was not made by Share`);
    return design;
  }
  const loops = ending(".loops");
  return {file: main.name, text, loops: loops ? await loops.text() : ""};
}

// Files that are dropped anywhere on the page.
export function listenToDrops(onFiles) {
  let depth = 0;
  const hasFiles = ({dataTransfer}) => [...(dataTransfer?.types ?? [])].includes("Files");
  addEventListener("dragenter", (event) => {
    if (hasFiles(event)) document.body.classList.toggle("dropping", ++depth > 0);
  });
  addEventListener("dragleave", (event) => {
    if (hasFiles(event)) document.body.classList.toggle("dropping", --depth > 0);
  });
  addEventListener("dragover", (event) => hasFiles(event) && event.preventDefault());
  addEventListener("drop", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    depth = 0;
    document.body.classList.remove("dropping");
    onFiles(event.dataTransfer.files);
  });
}

// The first comment of a model in a few words, and its name.
export function titleOf({name, text}) {
  const comment = text
    .split("\n")
    .filter((line) => line.startsWith("%"))
    .map((line) => line.slice(1).trim())
    .join(" ");
  return {
    name: name.replace(/^.*\//, "").replace(/_/g, " "),
    words: comment.split(/(?<=[a-z)])[.:] /)[0].replace(/ of \.\.\/\S+\.cuik/, ""),
  };
}
