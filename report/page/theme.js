// Light or dark: as the system says, until the button says otherwise.

export function takeTheme() {
  document.documentElement.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

export function followTheme(redraw) {
  const button = document.getElementById("theme"),
    media = matchMedia("(prefers-color-scheme: dark)");
  const apply = (theme) => {
    document.documentElement.dataset.theme = theme;
    button.setAttribute("aria-pressed", String(theme === "dark"));
    redraw();
  };
  button.addEventListener("click", () => apply(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
  media.addEventListener("change", () => apply(media.matches ? "dark" : "light"));
  button.setAttribute("aria-pressed", String(media.matches));
}
