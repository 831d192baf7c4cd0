// What stands above results while the frame file is refused: they are of another frame than the file.
import { doc, refused } from "../state/studio.ts";

export function LastGood() {
  if (!refused.value) return null;
  return (
    <p class="caution last-good" role="status">
      {doc.value.name}.toml is refused. What stands here is of the last good frame.
    </p>
  );
}
