for (const player of document.querySelectorAll(".player")) {
  const picture = player.querySelector("img"), range = player.querySelector("input");
  const button = player.querySelector("button");
  const frames = JSON.parse(player.querySelector("script").textContent);
  let timer = null;
  const show = number => { range.value = number; picture.src = frames[number]; };
  const stop = () => { clearInterval(timer); timer = null; button.textContent = "Play"; };
  const play = () => {
    timer = setInterval(() => show((+range.value + 1) % frames.length), 120);
    button.textContent = "Pause";
  };
  range.addEventListener("input", () => { stop(); show(+range.value); });
  button.addEventListener("click", () => timer === null ? play() : stop());
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) play();
}
